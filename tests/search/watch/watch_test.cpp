// Requests that `misalign watch` answers, where it listens, and how it notices that a catalogue has
// changed.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <thread>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue.hpp"
#include "schema/catalogue/writer_lock.hpp"
#include "schema/files/features.hpp"
#include "schema/files/input.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/watch/connection_patience.hpp"
#include "search/watch/file_mark.hpp"
#include "search/watch/folded_sheets.hpp"
#include "search/watch/loopback.hpp"
#include "search/watch/request_rule.hpp"
#include "search/watch/watched_catalogue.hpp"
#include "tests/folder.hpp"

namespace misalign::search {
namespace {

constexpr int kPort = 8617;
const PagePlace kPlace{"127.0.0.1", kPort};

PageRequest asked(const std::string& host = "127.0.0.1:8617") {
  return {"GET", "/", {host}, "", "", false};
}

int status_of(const PageRequest& request, const PagePlace& place = kPlace) {
  const std::optional<Refusal> refused = refusal(request, place);
  return refused ? refused->status : 200;
}

TEST(RequestRule, AnswersItsOwnNamesAlone) {
  for (const char* host : {"127.0.0.1:8617", "localhost:8617", "LocalHost:8617", "[::1]:8617"}) {
    EXPECT_EQ(status_of(asked(host)), 200) << host;
  }
  for (const char* host :
       {"", "127.0.0.1", "localhost", "127.0.0.1:80", "127.0.0.1:8617.", "evil.example",
        "evil.example:8617", "localhost.evil.example:8617", "127.0.0.1:8617@evil",
        "localhost:8617,evil.example", " localhost:8617", "127.0.0.2:8617"}) {
    EXPECT_EQ(status_of(asked(host)), 421) << host;
  }
  PageRequest none = asked();
  none.hosts.clear();
  EXPECT_EQ(status_of(none), 421);
  none.hosts = {"localhost:8617", "evil.example"};
  EXPECT_EQ(status_of(none), 421) << "two names";
}

TEST(RequestRule, KnowsItsOtherAddress) {
  EXPECT_EQ(status_of(asked("127.0.0.2:8617"), {"127.0.0.2", kPort}), 200);
  EXPECT_EQ(status_of(asked("[::1]:9"), {"::1", 9}), 200);
  EXPECT_EQ(status_of(asked("localhost"), {"127.0.0.1", 80}), 200) << "HTTP's own port is not said";
}

TEST(RequestRule, RefusesOtherSites) {
  const auto with = [](const std::string& origin, const std::string& site) {
    PageRequest request = asked();
    request.origin = origin;
    request.fetch_site = site;
    return status_of(request);
  };
  EXPECT_EQ(with("http://127.0.0.1:8617", "same-origin"), 200);
  EXPECT_EQ(with("", "none"), 200);
  for (const char* origin :
       {"null", "http://evil.example", "https://127.0.0.1:8617", "http://localhost:8617",
        "http://127.0.0.1:9999", "http://127.0.0.1:8617.evil.example"}) {
    EXPECT_EQ(with(origin, ""), 403) << origin;
  }
  for (const char* site : {"cross-site", "same-site", "x"}) EXPECT_EQ(with("", site), 403) << site;
}

TEST(RequestRule, ReadsKnownPathsAlone) {
  const auto with = [](const std::string& method, const std::string& path, bool range = false) {
    PageRequest request = asked();
    request.method = method;
    request.path = path;
    request.has_range = range;
    return status_of(request);
  };
  EXPECT_EQ(with("GET", "/"), 200);
  EXPECT_EQ(with("HEAD", "/live"), 200);
  EXPECT_EQ(with("GET", "/live", true), 416);
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "PATCH", "get", ""}) {
    EXPECT_EQ(with(method, "/"), 405) << method;
  }
  EXPECT_EQ(with("GET", "/sheet/9223372036854775807"), 200);
  EXPECT_EQ(sheet_asked("/sheet/1112"), 1112);
  for (const char* path :
       {"", "//", "/live/", "/../etc/passwd", "/index.html", "/live\n", "/sheet/", "/sheet/-1",
        "/sheet/1/", "/sheet/ 1", "/sheet/9223372036854775808"}) {
    EXPECT_EQ(with("GET", path), 404) << path;
  }
}

TEST(Loopback, IsTheOnlyAddress) {
  EXPECT_EQ(loopback_address("localhost", kPort), "127.0.0.1");
  EXPECT_EQ(loopback_address("127.0.0.1", kPort), "127.0.0.1");
  EXPECT_EQ(loopback_address("127.1.2.3", kPort), "127.1.2.3");
  EXPECT_EQ(loopback_address("::1", kPort), "::1");
  for (const char* other : {"0.0.0.0", "::", "*", "", "10.0.0.1", "192.168.1.5", "128.0.0.1",
                            "::ffff:10.0.0.1", "fe80::1", "no.such.name.invalid"}) {
    try {
      const std::string address = loopback_address(other, kPort);
      ADD_FAILURE() << other << " is taken for " << address;
    } catch (const schema::UserError& error) {
      EXPECT_EQ(error.cause(), schema::Cause::bad_request) << other;
      EXPECT_NE(std::string(error.what()).find("ssh -L 8617:127.0.0.1:8617"), std::string::npos);
    }
  }
  EXPECT_EQ(url_of("127.0.0.1", 80), "http://127.0.0.1:80/");
  EXPECT_EQ(url_of("::1", kPort), "http://[::1]:8617/");
}

// Both ends of a connection to this process.
struct Pair {
  int client, server;
  int client_port = 0;
};

class Patience : public testing::Test {
 protected:
  Patience() {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    bind(listening_, reinterpret_cast<sockaddr*>(&place), size);
    listen(listening_, 9);
    getsockname(listening_, reinterpret_cast<sockaddr*>(&place_), &size);
  }
  ~Patience() override {
    for (const int descriptor : descriptors_) close(descriptor);
    close(listening_);
  }
  int port() const { return ntohs(place_.sin_port); }

  Pair connected() {
    sockaddr_in own{};
    socklen_t size = sizeof own;
    Pair pair{socket(AF_INET, SOCK_STREAM, 0), -1};
    EXPECT_EQ(connect(pair.client, reinterpret_cast<const sockaddr*>(&place_), size), 0);
    pair.server = accept(listening_, nullptr, nullptr);
    getsockname(pair.client, reinterpret_cast<sockaddr*>(&own), &size);
    pair.client_port = ntohs(own.sin_port);
    descriptors_.insert(descriptors_.end(), {pair.client, pair.server});
    return pair;
  }

 private:
  const int listening_ = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place_{};
  std::vector<int> descriptors_;
};

bool is_open(const Pair& pair) {
  char byte;
  return recv(pair.server, &byte, 1, MSG_PEEK | MSG_DONTWAIT) != 0;
}

// Whether the server's end is shut within minutes.
bool ends(const Pair& pair) {
  pollfd event{pair.server, POLLIN, 0};
  return poll(&event, 1, 100'000) == 1 && !is_open(pair);
}

TEST_F(Patience, EndsWhoseRequestIsNotWhole) {
  const Pair slow = connected(), heard = connected();
  ConnectionPatience patience(port(), 32, {0.5, 1e9});
  patience.heard(heard.client_port);
  EXPECT_TRUE(ends(slow));
  const Pair later = connected();
  EXPECT_TRUE(ends(later));
  EXPECT_TRUE(is_open(heard)) << "older than who was ended";
}

TEST_F(Patience, EndsAnAnswerThatTakesTooLong) {
  const Pair pair = connected();
  ConnectionPatience patience(port(), 32, {1e9, 0.3});
  patience.heard(pair.client_port);
  EXPECT_TRUE(ends(pair));
}

TEST_F(Patience, LeavesWhoWaitsInTheQueue) {
  const Pair first = connected(), behind = connected();
  ConnectionPatience patience(port(), 1, {0.3, 1e9});
  EXPECT_TRUE(ends(first));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  EXPECT_TRUE(is_open(behind)) << "the first is still served, if only to be closed";
  close(first.server);  // which it is now
  EXPECT_TRUE(ends(behind));
}

// Sheets that a shell "folds" as soon as a file `go-DRAW` lets it; what began is in `begun`.
class SlowSheets {
 public:
  SlowSheets()
      : sheets([this](std::uint64_t draw) -> std::vector<std::string> {
          const std::string number = std::to_string(draw);
          return {"/bin/sh", "-c",
                  "cd " + folder_.path().string() + "; echo $$ > pid-" + number + "; echo " +
                      number + " >> begun; until [ -e go-" + number + " ]; do sleep 0.02; done; " +
                      R"(echo '{"details": [{"draw": ")" + number +
                      R"("}], "campaign": {"identity": "1a2b3c4d"}}')"};
        }) {}
  ~SlowSheets() {
    sheets.end();
    for (auto& [draw, request] : requests_) request.thread.join();
  }

  void ask(std::uint64_t draw) {
    Request& request = requests_[draw];
    request.thread = std::thread([this, draw, &request] {
      request.answer = sheets.sheet(draw, [&request] { return request.has_gone.load(); });
      request.is_answered = true;
    });
  }
  void leave(std::uint64_t draw) { requests_[draw].has_gone = true; }
  void let_go(std::uint64_t draw) const {
    std::ofstream(folder_.file("go-" + std::to_string(draw)));
  }
  const PageResponse& answer(std::uint64_t draw) {
    wait_until([&] { return requests_[draw].is_answered.load(); });
    return requests_[draw].answer;
  }
  std::string begun() const {
    std::ifstream file(folder_.file("begun"));
    std::string all;
    for (std::string line; std::getline(file, line);) all += line + " ";
    return all;
  }
  bool is_alive(std::uint64_t draw) const {
    int process = 0;
    std::ifstream(folder_.file("pid-" + std::to_string(draw))) >> process;
    return kill(process, 0) == 0;
  }
  static void wait_until(const std::function<bool()>& happens) {
    const auto begin = std::chrono::steady_clock::now();
    while (!happens()) {
      ASSERT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

 private:
  struct Request {
    std::thread thread;
    std::atomic<bool> has_gone = false, is_answered = false;
    PageResponse answer;
  };
  const Folder folder_{"sheets"};
  std::map<std::uint64_t, Request> requests_;

 public:
  FoldedSheets sheets;
};

TEST(FoldedSheets, EndWithWhoAskedForThemAndTheNewestIsFirst) {
  SlowSheets slow;
  slow.ask(1);
  SlowSheets::wait_until([&] { return slow.begun() == "1 "; });
  slow.ask(2);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  slow.ask(3);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(slow.begun(), "1 ") << "one at a time";
  slow.leave(1);
  EXPECT_EQ(slow.answer(1).status, 503);
  EXPECT_FALSE(slow.is_alive(1));
  SlowSheets::wait_until([&] { return slow.begun() == "1 3 "; });
  slow.let_go(3);
  EXPECT_EQ(slow.answer(3).status, 200);
  EXPECT_EQ(schema::Json::parse(*slow.answer(3).body),
            schema::Json::parse(R"({"detail": {"draw": "3"}, "identity": "1a2b3c4d"})"));
  SlowSheets::wait_until([&] { return slow.begun() == "1 3 2 "; });
  slow.ask(4);
  slow.leave(4);
  EXPECT_EQ(slow.answer(4).status, 503) << "whoever goes while others are served is not served";
  slow.sheets.end();
  EXPECT_EQ(slow.answer(2).status, 503);
  EXPECT_FALSE(slow.is_alive(2));
}

TEST(FoldedSheets, RefuseTheOldestOfTooMany) {
  SlowSheets slow;
  slow.ask(0);
  SlowSheets::wait_until([&] { return slow.begun() == "0 "; });
  for (std::uint64_t draw = 1; draw <= FoldedSheets::kMostWaiting; ++draw) {
    slow.ask(draw);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  slow.ask(100);
  EXPECT_EQ(slow.answer(1).status, 503);
  slow.let_go(100);
  slow.let_go(0);
  EXPECT_EQ(slow.answer(100).status, 200);
}

TEST(FoldedSheets, SayWhatTheProgramSays) {
  const auto never = [] { return false; };
  FoldedSheets failing([](std::uint64_t) -> std::vector<std::string> {
    return {"/bin/sh", "-c", "echo 'misalign: a.db: is no catalogue' >&2; exit 3"};
  });
  const PageResponse answer = failing.sheet(7, never);
  EXPECT_EQ(answer.status, 503);
  EXPECT_EQ(*answer.body, R"({"problem":"a.db: is no catalogue"})");
  FoldedSheets missing([](std::uint64_t) -> std::vector<std::string> { return {"/no/such"}; });
  EXPECT_EQ(missing.sheet(7, never).status, 503);
  FoldedSheets babbling([](std::uint64_t) -> std::vector<std::string> { return {"/bin/echo"}; });
  EXPECT_EQ(babbling.sheet(7, never).status, 503);
}

TEST_F(Patience, SeesThatTheOtherSideHasGone) {
  const Pair stays = connected(), goes = connected();
  const ConnectionPatience patience(port(), 8);
  EXPECT_FALSE(patience.has_gone(stays.client_port));
  EXPECT_FALSE(patience.has_gone(goes.client_port));
  close(goes.client);
  EXPECT_TRUE(patience.has_gone(goes.client_port));
  EXPECT_FALSE(patience.has_gone(stays.client_port));
}

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

// As if it had been written long ago.
void age(const std::string& path) {
  std::filesystem::last_write_time(
      path, std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
}

TEST(FileMark, NoticesCommitsReplacementAndTheWriter) {
  const Folder folder("watch_test");
  const std::string path = folder.file("a.db"), log = path + "-wal";
  EXPECT_FALSE(FileMark::of(path).exists());
  write(path, "catalogue");
  EXPECT_FALSE(FileMark::of(path).is_like(FileMark::of(path))) << "it may have changed this moment";
  age(path);
  const FileMark before = FileMark::of(path);
  EXPECT_TRUE(before.exists());
  EXPECT_FALSE(before.is_written());
  EXPECT_TRUE(before.is_like(FileMark::of(path)));
  write(log, "commit");
  EXPECT_FALSE(before.is_like(FileMark::of(path))) << "a log";
  age(log);
  const FileMark logged = FileMark::of(path);
  EXPECT_TRUE(logged.is_like(FileMark::of(path)));
  write(log, "COMMIT");  // as many bytes
  EXPECT_FALSE(logged.is_like(FileMark::of(path))) << "the log written again";
  std::filesystem::remove(log);
  write(folder.file("b.db"), "catalogue");
  age(folder.file("b.db"));
  std::filesystem::last_write_time(folder.file("b.db"), std::filesystem::last_write_time(path));
  std::filesystem::rename(folder.file("b.db"), path);
  EXPECT_FALSE(before.is_like(FileMark::of(path))) << "another file of the same size and time";
  const FileMark resting = FileMark::of(path);
  {
    const schema::WriterLock lock(path);
    EXPECT_TRUE(FileMark::of(path).is_written());
    EXPECT_FALSE(resting.is_like(FileMark::of(path))) << "a search has begun";
  }
  EXPECT_FALSE(FileMark::of(path).is_written());
  EXPECT_TRUE(resting.is_like(FileMark::of(path)));
}

// Whoever has waited for a lock has kept no core busy: the next look may be soon, where as a share
// of the clock ten seconds would ask for a rest of minutes.
TEST(WatchedCatalogue, LooksAgainSoonAfterALockIsGoneSlow) {
  if (!has("Node.js")) GTEST_SKIP() << "there is no page";
  const Folder folder("watched");
  const std::string path = folder.file("a.db");
  {
    const DrawEvaluator evaluator(schema::read_campaign(
        schema::Json::parse(R"({"pattern": {"family": "miura", "rows": 4, "columns": 4}})"),
        "test"));
    const schema::Catalogue made(path, evaluator.campaign(), evaluator.mechanism());
  }
  WatchedCatalogue watched(path, [](std::string_view name, bool) { return std::string(name); });
  {
    SQLite::Database other(path, SQLite::OPEN_READWRITE);
    other.exec("PRAGMA locking_mode = EXCLUSIVE; BEGIN EXCLUSIVE");
    EXPECT_EQ(watched.live().status, 503);
  }
  const auto begun = std::chrono::steady_clock::now();
  while (watched.live().status != 200) {
    ASSERT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(60));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace
}  // namespace misalign::search
