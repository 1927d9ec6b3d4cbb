#include "tests/simulation/told_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <limits>

#include "schema/catalogue/writer_lock.hpp"

namespace misalign::simulation {
namespace {

using schema::Json;

constexpr const char* kAway = "away.db";

}  // namespace

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

void Scene::fail(const std::string& why) {
  if (wrong.empty()) wrong = fmt::format("{} ({})", why, told.kind);
}

bool Scene::is_there(const std::string& name) const {
  return ::access(path(name).c_str(), F_OK) == 0;
}

ToldFile::ToldFile(Scene& scene, std::string name, Begins begins)
    : scene_(scene), name_(std::move(name)) {
  if (scene_.told.older_version && begins == Begins::told)
    scene_.disk.put(name_, bytes_of_file(scene_.told.older_path));
}

Life ToldFile::looking(void (*between)()) const {
  return visit(looking_at(name_, scene_.told.campaign, between));
}

Json ToldFile::look() {
  ++scene_.tally.looks;
  Json seen = answer_of(run_through(scene_.disk, looking()));
  if (seen.contains("sentence")) {
    const std::string sentence = seen["sentence"];
    if (!may_say(sentence)) scene_.fail("a reader says: " + sentence);
    return seen;
  }
  if (is_away_) return seen;                              // it may be another file
  if (is_harmed_ && seen.contains("wrong")) return seen;  // found; the next search must, too
  const bool is_durable = seen.value("runs", 0) >= least_runs_;
  const std::string wrong = kept_.take(seen, *scene_.expected, is_durable);
  if (!wrong.empty()) scene_.fail(wrong);
  return seen;
}

// A catalogue that was not closed is durable once the next program has begun its run.
Json ToldFile::look_after(const LifeEnd& end, std::uint64_t made) {
  const bool is_closed =
      !end.by_signal && !scene_.is_there(name_ + "-wal") && !scene_.is_there(name_ + "-journal");
  least_runs_ = is_closed ? 0 : std::numeric_limits<int>::max();
  Json seen = look();
  if (!is_closed) least_runs_ = seen.value("runs", 0) + 1;
  std::uint64_t done = 0;
  for (const Json& unit : seen.value("done", Json::array())) {
    done += unit[1].get<std::uint64_t>() - unit[0].get<std::uint64_t>();
  }
  if (!is_new_ && !is_harmed_) {
    expect_printed(end, done);
    if (made > 0 && done != done_ + made) {
      scene_.fail(fmt::format("of {} draws that were made {} were committed", made, done - done_));
    }
  }
  is_new_ = false;
  done_ = done;
  return seen;
}

// The draws that a summary has counted are there.
void ToldFile::expect_printed(const LifeEnd& end, std::uint64_t done) const {
  const std::size_t at = end.out.find(" draws, ");
  if (scene_.told.is_split || at == std::string::npos) return;
  const std::size_t begin = end.out.rfind(' ', at - 1) + 1;
  if (std::stoull(end.out.substr(begin)) > done) {
    scene_.fail("more draws were printed than there are");
  }
}

// It may have begun before an earlier look, and before there was a file.
void ToldFile::take_long_look(const LifeEnd& end, bool lost_index) {
  const Json seen = answer_of(end);
  if (lost_index && end.out.empty()) return;
  if (seen.contains("sentence")) {
    const std::string sentence = seen["sentence"];
    if (!may_say(sentence, true)) scene_.fail("a long reader says: " + sentence);
    return;
  }
  if (is_harmed_ && seen.contains("wrong")) return;
  const std::string wrong = Kept().take(seen, *scene_.expected, false);
  if (!wrong.empty()) scene_.fail("a long reader sees: " + wrong);
}

void ToldFile::expect_finished(bool is_merged) {
  if (!scene_.wrong.empty()) return;
  const Expected& expected = *scene_.expected;
  const Json seen = look();
  if (!seen.contains("digest")) return scene_.fail("at the end: " + seen.dump());
  const bool has_its_end =
      is_merged || (seen["goal_end"] == expected.goal_end && seen["gaps"] == 0);
  if (seen["digest"] != expected.digest || !has_its_end) {
    scene_.fail(fmt::format("another end: {} {} instead of {} {}", seen["digest"].dump(),
                            seen["goal_end"].dump(), expected.digest, expected.goal_end));
  }
  if (scene_.told.kind == "certified" && seen["certified"].size() != seen["accepted"].size()) {
    scene_.fail("a candidate has no certificate");
  }
}

void ToldFile::expect_alone() const {
  for (const char* suffix : {"-wal", "-journal"}) {
    std::error_code none;
    const std::uintmax_t bytes = std::filesystem::file_size(scene_.path(name_ + suffix), none);
    if (!none && bytes > 0) scene_.fail(fmt::format("{} bytes are left in {}", bytes, suffix));
  }
}

bool ToldFile::may_say(const std::string& sentence, bool may_be_empty) const {
  if (contains(sentence, "a journal to roll back") || contains(sentence, "keeps it locked")) {
    return true;
  }
  if (is_away_ && contains(sentence, "there is no such file")) return true;
  if (is_harmed_ && (contains(sentence, "is missing") || contains(sentence, "is damaged"))) {
    return true;
  }
  const bool is_begun = contains(sentence, "there is no such file") ||
                        contains(sentence, "is no catalogue") ||
                        contains(sentence, "cannot be opened");
  return is_begun && may_be_empty;
}

bool ToldFile::copy(bool with_log) {
  const std::string name = "copy.db";
  if (!scene_.is_there(name_)) return false;
  ++scene_.tally.copies;
  for (const std::string suffix : {"", "-wal", "-journal"}) {
    ::unlink(scene_.path(name + suffix).c_str());
    if (!scene_.is_there(name_ + suffix) || (!with_log && !suffix.empty())) continue;
    scene_.disk.put(name + suffix, bytes_of_file(scene_.path(name_ + suffix)));
  }
  ++scene_.tally.looks;
  const Json seen =
      answer_of(run_through(scene_.disk, visit(looking_at(name, scene_.told.campaign, nullptr))));
  if (seen.contains("sentence")) {
    const std::string sentence = seen["sentence"];
    // The file alone may be torn where the log was being folded in.
    const bool is_good = !with_log || contains(sentence, "is no catalogue") ||
                         contains(sentence, "a journal to roll back");
    if (!is_good) scene_.fail("of a copy a reader says: " + sentence);
    return false;
  }
  const std::string wrong = Kept().take(seen, *scene_.expected, false);
  if (!wrong.empty() && with_log) scene_.fail("a copy: " + wrong);
  return wrong.empty();
}

// Not before the search has opened it: it would make a file of that name.
void ToldFile::take_away() {
  if (is_away_ || !schema::is_being_written(scene_.path(name_))) return;
  is_away_ = true;
  ::rename(scene_.path(name_).c_str(), scene_.path(kAway).c_str());
}

void ToldFile::put_back() {
  if (scene_.is_there(kAway)) {  // or a power cut has undone it
    ::rename(scene_.path(kAway).c_str(), scene_.path(name_).c_str());
    scene_.disk.sync_names();
  }
  is_away_ = false;
}

void ToldFile::harm(Random& random) {
  if (happens(random, 0.5)) return begin_anew();
  if (!scene_.is_there(name_ + "-wal")) return;
  ::unlink(scene_.path(name_ + "-wal").c_str());
  scene_.disk.sync_names();
  kept_.forget();
  is_harmed_ = true;
}

void ToldFile::take_refusal() {
  const Json seen = look();
  if (!seen.contains("wrong") && !seen.contains("sentence")) {
    scene_.fail("a sound file was refused");
  }
  begin_anew();
}

// A backup of an older program's file takes the place of file and journals.
void ToldFile::begin_anew() {
  ::unlink(scene_.path(name_).c_str());
  if (scene_.told.older_version) {
    for (const char* suffix : {"-wal", "-journal", "-shm"}) {
      ::unlink(scene_.path(name_ + suffix).c_str());
    }
    scene_.disk.put(name_, bytes_of_file(scene_.told.older_path));
  }
  scene_.disk.sync_names();
  kept_.forget();
  is_harmed_ = false;
  is_new_ = true;
}

}  // namespace misalign::simulation
