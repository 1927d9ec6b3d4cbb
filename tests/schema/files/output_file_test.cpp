// Files in the making: nothing that is there is touched, and nothing of theirs is left.
#include "schema/files/output_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "tests/schema/catalogue_fixture.hpp"
#include "tests/schema/files/failing_calls.hpp"

namespace misalign::schema {
namespace {

constexpr int kRefused = 1;  // exit code of a child

class OutputFileTest : public CatalogueTest {
 protected:
  static constexpr const char* kName = "all.db.0123456789abcdef0123456789abcdef.partial";

  void put(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  std::string held(const std::string& name) const {
    std::ifstream in(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string names() const {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      all.push_back(entry.path().filename());
    }
    std::sort(all.begin(), all.end());
    std::string text;
    for (const std::string& name : all) text += (text.empty() ? "" : " ") + name;
    return text;
  }
  OutputFile database(const std::vector<std::string>& originals = {}) const {
    return OutputFile::database(path("all.db"), originals);
  }
};

TEST_F(OutputFileTest, EveryWayOfNamingLeavesWhatIsThere) {
  const auto kWays = {rename_to_new, link_to_new, rename_over_empty};
  for (const auto& way : kWays) {
    put("from", "new");
    EXPECT_EQ(way(path("from"), path("to")), 0);
    EXPECT_EQ(names(), "to");
    EXPECT_EQ(held("to"), "new");
    put("from", "newer");
    EXPECT_EQ(way(path("from"), path("to")), EEXIST);
    EXPECT_EQ(held("to"), "new");
    EXPECT_EQ(held("from"), "newer");
    std::filesystem::remove(path("to"));
    std::filesystem::create_symlink("nowhere", path("to"));
    EXPECT_EQ(way(path("from"), path("to")), EEXIST);
    EXPECT_EQ(names(), "from to");
    std::filesystem::remove(path("to"));
    EXPECT_EQ(way(path("nothing"), path("to")), ENOENT);
    EXPECT_EQ(names(), "from");
    std::filesystem::remove(path("from"));
  }
}

TEST_F(OutputFileTest, AppearsWholeOrNotAtAll) {
  {
    OutputFile file = database();
    std::ofstream(file.path()) << "whole";
    std::ofstream(file.path() + "-wal") << "of a connection that failed";
    EXPECT_FALSE(is_taken(path("all.db")));
  }
  EXPECT_EQ(names(), "");
  {
    OutputFile file = database();
    std::ofstream(file.path()) << "whole";
    file.publish();
  }
  EXPECT_EQ(names(), "all.db");
  EXPECT_EQ(held("all.db"), "whole");
  EXPECT_EQ(refusal([&] { database(); }).cause, Cause::bad_request);
  EXPECT_EQ(held("all.db"), "whole");
}

TEST_F(OutputFileTest, WhatCameMeanwhileStays) {
  {
    OutputFile file = database();
    put("all.db", "another's");
    EXPECT_EQ(refusal([&] { file.publish(); }).cause, Cause::bad_request);
  }
  EXPECT_EQ(names(), "all.db");
  EXPECT_EQ(held("all.db"), "another's");
  std::filesystem::remove(path("all.db"));
  {
    OutputFile file = database();
    std::filesystem::remove(file.path());
    std::ofstream(file.path()) << "another's";  // somebody who knew the name
  }
  EXPECT_NE(names(), "");
}

// A disk that failed as the last connection closed: the rest is in the log, and lost without it.
TEST_F(OutputFileTest, WhatIsPartlyInAJournalIsNotPublished) {
  for (const char* suffix : {"-wal", "-journal"}) {
    {
      OutputFile file = database();
      std::ofstream(file.path()) << "half";
      std::ofstream(file.path() + suffix) << "the other half";
      EXPECT_EQ(refusal([&] { file.publish(); }).cause, Cause::failure);
    }
    EXPECT_EQ(names(), "");
  }
  OutputFile file = database();
  for (const char* suffix : {"-wal", "-shm"}) std::ofstream(file.path() + suffix);
  file.publish();
  EXPECT_EQ(names(), "all.db");
}

TEST_F(OutputFileTest, JournalsBesideTheOutputAreNotTaken) {
  for (const char* name : {"all.db-wal", "all.db-journal", "all.db-shm"}) {
    put(name, "mine");
    const Refusal r = refusal([&] { database(); });
    EXPECT_EQ(r.cause, Cause::bad_request);
    EXPECT_EQ(r.sentence.find(path(name)), 0u) << r.sentence;
    EXPECT_EQ(names(), name);
    std::filesystem::remove(path(name));
  }
}

TEST_F(OutputFileTest, WhatAKilledProcessLeftIsRemoved) {
  put(kName, "half");
  put(std::string(kName) + "-wal", "of it");
  const OutputFile file = database();
  EXPECT_EQ(names(), std::filesystem::path(file.path()).filename());
}

TEST_F(OutputFileTest, NothingElseOfThatNameIsRemoved) {
  const auto kept = [&](const std::string& name, const std::vector<std::string>& originals = {}) {
    { database(originals); }
    EXPECT_NE(names().find(name), std::string::npos) << names();
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      std::filesystem::remove(entry);
    }
  };
  put(kName, "an input");
  kept(kName, {path(kName)});
  put("precious", "");
  std::filesystem::create_symlink("precious", path(kName));
  kept("precious");
  std::filesystem::create_symlink("precious", path(kName));
  kept(kName);
  ASSERT_EQ(::mkfifo(path(kName).c_str(), 0600), 0);
  kept(kName);
  put("precious", "");
  std::filesystem::create_hard_link(path("precious"), path(kName));
  kept(kName);
  std::filesystem::create_directory(path(kName));
  kept(kName);
  for (const char* name :
       {"all.db.partial", "all.db.0123456789abcdef0123456789abcdeg.partial",
        "all.db.0123456789abcdef.partial", "a.db.0123456789abcdef0123456789abcdef.partial"}) {
    put(name, "another's");
    kept(name);
  }
}

TEST_F(OutputFileTest, OneProcessAtATime) {
  OutputFile first = database();
  const Refusal r = refusal([&] { database(); });
  EXPECT_EQ(r.cause, Cause::in_use);
  EXPECT_EQ(r.sentence.find(path("all.db")), 0u) << r.sentence;
  std::ofstream(first.path()) << "whole";
  first.publish();
  EXPECT_EQ(held("all.db"), "whole");
}

TEST_F(OutputFileTest, WhatIsPrivateStaysPrivate) {
  const auto mode = [&](const std::string& name) {
    struct stat found {};
    EXPECT_EQ(::stat(path(name).c_str(), &found), 0);
    return found.st_mode & 0777;
  };
  const mode_t before = ::umask(022);
  const auto made_of = [&](const std::vector<mode_t>& modes) {
    std::vector<std::string> originals;
    for (const mode_t m : modes) {
      originals.push_back(path(std::to_string(originals.size())));
      put(std::to_string(originals.size() - 1), "");
      ::chmod(originals.back().c_str(), m);
    }
    database(originals).publish();
    const mode_t made = mode("all.db");
    std::filesystem::remove(path("all.db"));
    return made;
  };
  EXPECT_EQ(made_of({0644, 0644}), 0644u);
  EXPECT_EQ(made_of({0644, 0600}), 0600u);
  EXPECT_EQ(made_of({0640}), 0640u);
  EXPECT_EQ(made_of({0666}), 0644u);
  EXPECT_EQ(made_of({0444}), 0644u);  // its owner writes it
  put("page", "old");
  ::chmod(path("page").c_str(), 0660);
  write_text_file(path("page"), "new");
  EXPECT_EQ(mode("page"), 0660u);
  EXPECT_EQ(held("page"), "new");
  write_text_file(path("other"), "new");
  EXPECT_EQ(mode("other"), 0644u);
  ::umask(before);
}

// As a quota or a full disk ends it: the older file stays as it is.
TEST_F(OutputFileTest, ATextThatCannotBeWrittenLeavesTheOlderOne) {
  put("page", "old");
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 1000;
  ::setrlimit(RLIMIT_FSIZE, &small);
  const Refusal r = refusal([&] { write_text_file(path("page"), std::string(5000, 'x')); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(r.cause, Cause::failure);
  EXPECT_EQ(r.sentence.find(path("page")), 0u) << r.sentence;
  EXPECT_EQ(held("page"), "old");
  EXPECT_EQ(names(), "page");
}

TEST_F(OutputFileTest, LinksAreFollowedToTheirEndAndCirclesRefused) {
  std::filesystem::create_directory(path("deep"));
  std::filesystem::create_symlink("deep/one", path("page"));
  std::filesystem::create_symlink("../two", path("deep/one"));
  write_text_file(path("page"), "text");
  EXPECT_EQ(held("two"), "text");
  EXPECT_TRUE(std::filesystem::is_symlink(path("deep/one")));
  std::filesystem::create_symlink("circle", path("circle"));
  EXPECT_EQ(refusal([&] { write_text_file(path("circle"), "text"); }).cause, Cause::failure);
}

TEST_F(OutputFileTest, NoTextReplacesADatabase) {
  open();
  const std::string before = held("a.db");
  put("a.db-wal", "");
  for (const char* name : {"a.db", "a.db-wal", "a.db-shm"}) {
    EXPECT_EQ(refusal([&] { write_text_file(path(name), "text"); }).cause, Cause::bad_request)
        << name;
  }
  EXPECT_EQ(held("a.db"), before);
  EXPECT_EQ(names(), "a.db a.db-wal");
}

// It may be a catalogue: of somebody else, or on a disk that fails.
TEST_F(OutputFileTest, NoTextReplacesWhatCannotBeRead) {
  constexpr unsigned kHeader_bytes = 16;
  const std::pair<FailingCall, const char*> kFailures[] = {
      {{SYS_openat, O_RDONLY | O_NONBLOCK | O_CLOEXEC, EACCES}, "Permission denied"},
      {{SYS_openat, O_RDONLY | O_NONBLOCK | O_CLOEXEC, EIO}, "Input/output error"},
      {{SYS_read, kHeader_bytes, EIO}, "Input/output error"},
      {{SYS_read, kHeader_bytes, EINTR}, "Input/output error"}};
  open();
  const std::string before = held("a.db");
  for (const auto& [failure, why] : kFailures) {
    for (const char* name : {"a.db", "a.db-wal"}) {
      const int code = where_fails(failure, [&] {
        const Refusal r = refusal([&] { write_text_file(path(name), "text"); });
        const bool is_said = r.sentence.find(path(name)) == 0u &&
                             r.sentence.find("cannot be read") != std::string::npos &&
                             r.sentence.find(why) != std::string::npos;
        return is_said && r.cause == Cause::failure ? kRefused : 50;
      });
      if (code == -2) GTEST_SKIP() << "no seccomp here";
      EXPECT_EQ(code, kRefused) << name << ", " << why;
      EXPECT_TRUE(held("a.db") == before) << why;
      EXPECT_EQ(names(), "a.db") << why;
    }
  }
  write_text_file(path("a.txt"), "text");  // nothing is there
  write_text_file(path("a.txt"), "new");
  EXPECT_EQ(held("a.txt"), "new");
}

// A signal interrupts; a file system that says so for ever is broken.
TEST_F(OutputFileTest, InterruptionsEnd) {
  const std::string text(7777, 'x');
  put("page", "old");
  const int code = where_fails({SYS_write, static_cast<unsigned>(text.size()), EINTR}, [&] {
    const Refusal r = refusal([&] { write_text_file(path("page"), text); });
    return r.cause == Cause::failure ? kRefused : 50;
  });
  if (code == -2) GTEST_SKIP() << "no seccomp here";
  EXPECT_EQ(code, kRefused);
  EXPECT_EQ(held("page"), "old");
  EXPECT_EQ(names(), "page");
}

}  // namespace
}  // namespace misalign::schema
