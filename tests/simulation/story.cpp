#include "tests/simulation/story.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/writer_lock.hpp"
#include "search/terminal/failure.hpp"
#include "search/watch/live_state.hpp"
#include "tests/simulation/endings.hpp"

namespace misalign::simulation {
namespace {

using schema::Json;

// The watching page's reader, which reads once.
std::function<int(int)> watching(const std::string& file, const schema::Campaign& campaign) {
  return [=](int) {
    try {
      const auto database = schema::open_for_reading(file);
      search::live_state_json(*database, campaign);
      return 0;
    } catch (const std::exception& error) {
      std::fputs(search::failure_of(error).what(), stderr);
      return 1;
    }
  };
}

class Story {
 public:
  Story(std::uint64_t seed, Disk& disk, const Cast& cast, Tally& tally, int& planned)
      : random_(seed),
        told_(told_by(seed, random_)),
        disk_(disk),
        cast_(cast),
        tally_(tally),
        planner_(told_, cast, planned) {}

  std::string play() {
    set_tempo(told_.tempo);
    expected_ = &expected_of(told_, disk_);
    disk_.clear();
    disk_.put("told.json", told_.file.dump());
    ++tally_.seeds;
    tally_.migrations += told_.older_version > 0;
    tally_.real_seeds += told_.tempo.is_real;
    const bool has_fixed_end = !told_.campaign.stop.accepted;  // whatever a file holds
    const bool is_divided =
        told_.older_version == 0 && has_fixed_end && told_.goal > 2 && happens(random_, 0.12);
    std::vector<std::string> files = {"a.db"};
    if (is_divided) {
      files.push_back("b.db");
      const std::uint64_t middle = 1 + up_to(random_, told_.goal - 1);
      const std::uint64_t overlap = up_to(random_, 1 + std::min(middle, told_.goal / 4));
      live_through({"a.db", 0, middle});
      live_through({"b.db", middle - overlap, told_.goal});
    } else {
      live_through({"a.db", 0, told_.goal});
    }
    if (has_copy_ && has_fixed_end) files.push_back("copy.db");
    if (files.size() > 1) merge(files);
    if (is_divided) return wrong_;
    check_end("a.db");
    if (expected_->accepted.empty()) return wrong_;
    if (told_.kind == "plain" && happens(random_, 0.06)) study("a.db");
    // Its candidates are real ones.
    if (told_.older_version && !told_.is_split && happens(random_, 0.3)) export_candidate();
    return wrong_;
  }

 private:
  void fail(const std::string& why) {
    if (wrong_.empty()) wrong_ = fmt::format("{} ({})", why, told_.kind);
  }

  void live_through(Share share) {
    if (!wrong_.empty()) return;
    if (told_.older_version) disk_.put(share.file, bytes_of_file(told_.older_path));
    kept_ = &kept_of_[share.file];
    least_runs_ = 0;
    done_before_ = draws_to_find_ = 0;
    is_harmed_ = false;
    calls_before_ = 500;
    const auto faulty = static_cast<int>(up_to(random_, 5));
    share.on_network = happens(random_, 0.1);
    constexpr int kMostCleanLives = 3;
    for (int life = 0; wrong_.empty(); ++life) {
      Random of_life(random_());
      const bool is_faulty = life < std::min(faulty, cast_.most_faulty_lives);
      if (life >= faulty + kMostCleanLives) return fail("it comes to no end: " + last_.err);
      if (live(share, is_faulty, of_life)) return;
      if (is_faulty && happens(of_life, 0.06) && planner_.is_in()) harm(share.file, of_life);
      const Json seen = look_afterwards(share.file);
      const bool has_candidates = !seen.value("accepted", Json::array()).empty();
      const bool can_be_studied = told_.kind == "plain" || told_.kind == "splitting";
      const double often = told_.is_split ? 0.4 : 0.15;
      if (has_candidates && can_be_studied && !is_harmed_ && happens(of_life, often)) {
        study(share.file);
      }
    }
  }

  // Runs a search once; returns whether the campaign is complete.
  bool live(const Share& share, bool is_faulty, Random& random) {
    share_ = &share;
    const Planned planned = planner_.search(share, is_faulty, calls_before_, random);
    const std::uint64_t errors = disk_.state().errors;
    std::uint64_t draws_made = 0;
    circumstances_ = {};
    was_disturbed_ = has_index_cut_ = false;
    {
      Process search(disk_, planned.life);
      while (const auto visit = search.run_on()) {
        was_disturbed_ = true;
        receive(static_cast<Visit>(*visit), share.file, random);
      }
      circumstances_.was_ended = disk_.state().has_ended;
      const DiskState& state = disk_.state();
      if (state.asked_at >= 0) {
        circumstances_.stop_s = static_cast<double>(state.ended_at - state.asked_at) / 1e9;
      }
      draws_made = state.draws_made;
      end_visits();
      ended(planned.life, search.end(), random);
    }
    tally_.stops += planned.has_signal;
    tally_.lost_ranks += planned.has_silence;
    circumstances_.had_error = disk_.state().errors > errors;
    if (circumstances_.was_taken_away) put_back(share.file);
    const bool is_alone = !was_disturbed_ && !is_harmed_ && !circumstances_.had_error;
    const bool has_time = planned.is_drain || (planned.has_max_time && !planned.has_signal);
    const bool makes_plain_draws = told_.work == Work::unit || told_.kind == "certified";
    if (is_alone && has_time && makes_plain_draws && !last_.by_signal && !planned.has_silence) {
      draws_to_find_ = draws_made;
    }
    const bool is_complete = is_as_documented(planned, share.file);
    // The program has taken what was left for sound, and is held to it.
    if (is_complete || ended_early(last_, planned, share.file)) is_harmed_ = false;
    circumstances_.was_taken_away = false;
    return is_complete;
  }

  // Counts a life, and lets a power cut have its effect.
  void ended(const Life& life, const LifeEnd& end, Random& random) {
    last_ = end;
    calls_before_ = std::max<std::uint64_t>(end.calls, 50);
    ++tally_.lives;
    tally_.kills += end.was_killed() && !end.lost_power;
    tell(life);
    if (end.lost_power || happens(random, 0.05)) lose_power(random);
  }

  // Some power cuts come when nothing is under way.
  void lose_power(Random& random) {
    ++tally_.power_cuts;
    disk_.lose_power(random);
    for (auto& [file, kept] : kept_of_) kept.lose_power();
  }

  // A catalogue that was not closed is durable once the next program has begun its run.
  Json look_afterwards(const std::string& file) {
    Json seen = look_at(file);
    const bool is_closed =
        !last_.by_signal && !is_there(file + "-wal") && !is_there(file + "-journal");
    least_runs_ = is_closed ? 0 : seen.value("runs", 0) + 1;
    take(seen);
    check_effort(seen);
    return seen;
  }

  // No draw is made for nothing by a search that has the time to commit it.
  void check_effort(const Json& seen) {
    std::uint64_t done = 0;
    for (const Json& unit : seen.value("done", Json::array())) {
      done += unit[1].get<std::uint64_t>() - unit[0].get<std::uint64_t>();
    }
    // The draws that the summary has counted are there.
    const std::size_t at = last_.out.find(" draws, ");
    const std::size_t begin = last_.out.rfind(' ', at == std::string::npos ? at : at - 1);
    if (!told_.is_split && at != std::string::npos && !is_harmed_ &&
        std::stoull(last_.out.substr(begin + 1)) > done) {
      fail("more draws were printed than there are");
    }
    const std::uint64_t made = std::exchange(draws_to_find_, 0);
    if (made > 0 && done != done_before_ + made) {
      fail(fmt::format("of {} draws that were made {} were committed", made, done - done_before_));
    }
    done_before_ = done;
  }

  // While the search stands still.
  void receive(Visit visit, const std::string& file, Random& random) {
    switch (visit) {
      case Visit::look:
        take(look_at(file));
        break;
      case Visit::long_look:
        if (!reader_) {
          ++tally_.looks;
          reader_ = std::make_unique<Process>(disk_, looking(file, [] { stand_still(0); }));
          reader_->run_on();
        }
        break;
      case Visit::end_long_look:
        end_visits();
        break;
      case Visit::lock:
        if (locker_) break;
        ++tally_.lock_holders;
        locker_ = std::make_unique<Process>(disk_, locking(file));
        circumstances_.was_locked = true;
        locker_->run_on();
        break;
      case Visit::unlock:
        locker_.reset();
        break;
      case Visit::copy:
        copy_now(file, happens(random, 0.5));
        break;
      case Visit::take_away:
        // Not before the search has opened it: it would make a file of that name.
        if (schema::is_being_written(path(file)) && !circumstances_.was_taken_away) {
          circumstances_.was_taken_away = true;
          ::rename(path(file).c_str(), path("away.db").c_str());
        }
        break;
      case Visit::second_search: {
        ++tally_.second_searches;
        std::vector<std::string> words = {"search", "told.json", "--catalogue", file};
        words.insert(words.end(), {"--allow-mixed-builds", "--progress", "none"});
        const auto goal = told_.goal_words(share_->lo, share_->hi);
        words.insert(words.end(), goal.begin(), goal.end());
        const LifeEnd end = run_through(disk_, visiting(program(words)));
        // It is the first one where the other has not opened the file yet.
        if (end.code != 4 && end.code != 0) fail("a second search: " + end.err);
        break;
      }
      case Visit::cut_index:
        has_index_cut_ = true;
        if (is_there(file + "-shm")) [[maybe_unused]]
          const int cut = ::truncate(path(file + "-shm").c_str(), 0);
        break;
      default:
        read_by_verb(visit, file);
    }
  }

  static Life visiting(std::function<int(int)> its_program) {
    Life life{std::move(its_program)};
    life.is_visit = true;
    return life;
  }

  Life looking(const std::string& file, void (*between)()) const {
    return visiting([this, file, between](int) {
      print_look(file, told_.campaign, between);
      return 0;
    });
  }

  // Another program that holds the lock of SQLite's writer, if it gets it.
  static Life locking(const std::string& file) {
    return visiting([file](int) {
      try {
        SQLite::Database database(file, SQLite::OPEN_READWRITE, 0);
        SQLite::Transaction held(database, SQLite::TransactionBehavior::IMMEDIATE);
        stand_still(0);
      } catch (const SQLite::Exception&) {
        stand_still(0);
      }
      return 0;
    });
  }

  Json look_at(const std::string& file) {
    ++tally_.looks;
    const LifeEnd end = run_through(disk_, looking(file, nullptr));
    const Json seen = Json::parse(end.out, nullptr, false);
    if (seen.is_discarded()) return {{"wrong", "a reader ended without an answer: " + end.err}};
    return seen;
  }

  void take(const Json& seen) {
    if (seen.contains("sentence")) {
      if (!is_a_good_sentence(seen["sentence"], kept_->is_empty()))
        fail("a reader says: " + seen["sentence"].get<std::string>());
      return;
    }
    if (circumstances_.was_taken_away) return;         // it may be another file
    if (is_harmed_ && seen.contains("wrong")) return;  // found; the next search must find it, too
    const bool is_durable = seen.value("runs", 0) >= least_runs_;
    const std::string wrong = kept_->take(seen, *expected_, is_durable);
    if (!wrong.empty()) fail(wrong);
  }

  // Returns whether a reader may say so of a file that a search writes, or has left.
  bool is_a_good_sentence(const std::string& sentence, bool may_be_empty) const {
    if (contains(sentence, "a journal to roll back") || contains(sentence, "keeps it locked"))
      return true;
    if (circumstances_.was_taken_away && contains(sentence, "there is no such file")) return true;
    if (is_harmed_ && (contains(sentence, "is missing") || contains(sentence, "is damaged")))
      return true;
    const bool is_begun = contains(sentence, "there is no such file") ||
                          contains(sentence, "is no catalogue") ||
                          contains(sentence, "cannot be opened");
    return is_begun && may_be_empty;
  }

  void end_visits() {
    locker_.reset();
    if (!reader_) return;
    while (reader_->run_on()) continue;
    const Json seen = Json::parse(reader_->end().out, nullptr, false);
    reader_.reset();
    if (seen.is_discarded() && has_index_cut_) return;  // its index was cut short, too
    if (seen.is_discarded()) return fail("a long reader ended without an answer");
    // It may have begun before an earlier look, and before there was a file.
    Kept at_its_moment;
    if (seen.contains("sentence")) {
      if (!is_a_good_sentence(seen["sentence"], true)) {
        fail("a long reader says: " + seen["sentence"].get<std::string>());
      }
      return;
    }
    if (is_harmed_ && seen.contains("wrong")) return;
    const std::string wrong = at_its_moment.take(seen, *expected_, false);
    if (!wrong.empty()) fail("a long reader sees: " + wrong);
  }

  void read_by_verb(Visit visit, const std::string& file) {
    using Words = std::vector<std::string>;
    Life reading = visiting({});
    switch (visit) {
      case Visit::status:
        reading.program = program(Words{"status", file, "--json"});
        break;
      case Visit::query:
        reading.program = program(Words{"query", file, "best", "--json"});
        break;
      case Visit::verify:
        reading.program = program(Words{"verify", file, "--sample", "0"});
        break;
      default:
        reading.program = watching(file, told_.campaign);
    }
    ++tally_.looks;
    const LifeEnd end = run_through(disk_, reading);
    const bool is_good =
        !end.by_signal && (end.code == 0 || is_a_good_sentence(end.err, kept_->is_empty()));
    if (!is_good) fail(fmt::format("a reader ends with {}: {}{}", end.code, end.err, end.out));
  }

  // A copy of the file, with its log or alone, as a backup script makes it.
  void copy_now(const std::string& file, bool with_log) {
    if (!is_there(file)) return;
    ++tally_.copies;
    for (const char* suffix : {"", "-wal", "-journal"}) {
      ::unlink(path(std::string("copy.db") + suffix).c_str());
      const bool is_copied = is_there(file + suffix) && (*suffix == '\0' || with_log);
      if (is_copied) disk_.put(std::string("copy.db") + suffix, bytes_of_file(path(file + suffix)));
    }
    const Json seen = look_at("copy.db");
    has_copy_ = false;
    if (seen.contains("sentence")) {
      const std::string sentence = seen["sentence"];
      // The file alone may be torn where the log was being folded in.
      const bool may_say = !with_log || contains(sentence, "is no catalogue") ||
                           contains(sentence, "a journal to roll back");
      if (!may_say) fail("of a copy a reader says: " + sentence);
      return;
    }
    Kept of_copy;
    const std::string wrong = of_copy.take(seen, *expected_, false);
    has_copy_ = wrong.empty();
    if (!wrong.empty() && with_log) fail("a copy: " + wrong);
  }

  // People lose the log, or the file and not its log. What was kept is gone.
  void harm(const std::string& file, Random& random) {
    const std::string victim = happens(random, 0.5) ? file + "-wal" : file;
    if (!is_there(victim)) return;
    ::unlink(path(victim).c_str());
    disk_.sync_names();
    is_harmed_ = victim != file;
    draws_to_find_ = 0;
    last_.out.clear();
    kept_->forget();
    if (victim == file) begin_anew(file);
  }

  // Removes the file; a backup of an older program's takes the place of file and journals.
  void begin_anew(const std::string& file) {
    is_harmed_ = false;
    last_.out.clear();
    kept_->forget();
    ::unlink(path(file).c_str());
    if (told_.older_version) {
      for (const char* suffix : {"-wal", "-journal", "-shm"}) ::unlink(path(file + suffix).c_str());
      disk_.put(file, bytes_of_file(told_.older_path));
    }
    disk_.sync_names();
  }

  // A file that was taken away before the search opened it is another one now.
  void put_back(const std::string& file) {
    if (!is_there("away.db")) return;  // a power cut has undone it
    if (is_there(file)) {
      ::unlink(path("away.db").c_str());
      kept_->forget();
    } else {
      ::rename(path("away.db").c_str(), path(file).c_str());
    }
    disk_.sync_names();
  }

  std::string path(const std::string& name) const { return disk_.folder() + "/" + name; }
  bool is_there(const std::string& name) const { return ::access(path(name).c_str(), F_OK) == 0; }

  // Compares the end of a life with the manual's; returns whether the campaign is complete.
  bool is_as_documented(const Planned& planned, const std::string& file) {
    const LifeEnd& end = last_;
    const bool is_refused = contains(end.err, "is missing") || contains(end.err, "is damaged");
    if (is_harmed_ && end.code == 3 && is_refused) {
      begin_anew(file);
      return false;
    }
    const std::string what = unexplained(end, planned, circumstances_, file);
    if (!what.empty()) {
      fail(fmt::format("{}: {} {}: {}{}", what, end.by_signal ? "signal" : "exit code", end.code,
                       end.err, end.out));
    }
    const bool is_complete = says_complete(end, file) && end.code == 0;
    const bool has_ended = contains(end.out, file + ": ");  // and not before it began
    if (is_complete || (has_ended && ended_early(end, planned, file))) check_whole(file);
    return is_complete;
  }

  // A run that ended as it should leaves one file.
  void check_whole(const std::string& file) {
    if (was_disturbed_) return;
    for (const char* suffix : {"-wal", "-journal"}) {
      std::error_code none;
      const std::uintmax_t bytes = std::filesystem::file_size(path(file + suffix), none);
      if (!none && bytes > 0) fail(fmt::format("{} bytes are left in {}", bytes, suffix));
    }
  }

  void check_end(const std::string& file) {
    if (!wrong_.empty()) return;
    if (happens(random_, 0.1)) lose_power(random_);
    const Expected& expected = *expected_;
    const Json seen = look_at(file);
    if (seen.contains("sentence"))
      return fail("at the end: " + seen["sentence"].get<std::string>());
    take(seen);
    const bool is_merged = file == "all.db";  // whose goal may have no end of its own
    if (seen["digest"] != expected.digest ||
        (!is_merged && (seen["goal_end"] != expected.goal_end || seen["gaps"] != 0))) {
      fail(fmt::format("another end: {} {} instead of {} {}", seen["digest"].dump(),
                       seen["goal_end"].dump(), expected.digest, expected.goal_end));
    }
    if (told_.kind == "certified" && seen["certified"].size() != seen["accepted"].size())
      fail("a candidate has no certificate");
  }

  // Runs a verb, twice with faults, until it is done; whatever it leaves before must be good.
  void run_until(const std::vector<std::string>& words, Work work, int ranks,
                 const std::function<bool()>& is_done) {
    constexpr int kMostLives = 5;
    for (int life = 0; wrong_.empty(); ++life) {
      Random random(random_());
      Life trying{program(words), ranks, random(), static_cast<int>(work)};
      if (life < 2) planner_.add_faults(trying, calls_before_, random);
      const std::uint64_t errors = disk_.state().errors;
      ended(trying, run_through(disk_, trying), random);
      if (is_done()) return;
      const bool says_why = !last_.by_signal && contains(last_.err, "misalign: ");
      const bool has_cause = last_.was_killed() || (disk_.state().errors > errors && says_why);
      if (!has_cause || life == kMostLives) fail(words[0] + " is not done: " + last_.err);
    }
  }

  // Joins the parts, and a copy of one; the output is whole as soon as it is there.
  void merge(const std::vector<std::string>& files) {
    ++tally_.merges;
    kept_ = &kept_of_["all.db"];
    least_runs_ = 0;
    std::vector<std::string> words = {"merge", "all.db", "--allow-mixed-builds"};
    words.insert(words.end(), files.begin(), files.end());
    run_until(words, Work::merge, 1, [&] { return is_there("all.db"); });
    for (const char* file : {"a.db", "b.db"}) kept_->take_studies(kept_of_[file]);
    check_end("all.db");
  }

  // Certificates and yields of the best candidates, by their verbs.
  void study(const std::string& file) {
    const auto is_done = [&](std::uint64_t& runs) {
      ++runs;
      look_afterwards(file);
      // A power cut may have taken what no search had synced.
      const bool has_none = contains(last_.err, "holds no such candidate");
      return !last_.by_signal && (last_.code == 0 || has_none);
    };
    if (happens(random_, 0.5)) {
      run_until({"certify", file, "--best", "3"}, Work::certificate,
                std::min(planner_.ranks(random_), 3), [&] { return is_done(tally_.certify_runs); });
    } else {
      run_until({"tolerance", file, "--best", "2", "--amplitude", "0.05", "--trials", "40",
                 "--jobs", "1"},
                Work::yield, 1, [&] { return is_done(tally_.yield_runs); });
    }
  }

  // Exports a candidate: each file is there as a whole, or not at all.
  void export_candidate() {
    std::map<std::string, std::set<std::string>> contents;
    const auto names = [&](const std::string& ending) {
      std::vector<std::string> found;
      for (const auto& entry : std::filesystem::directory_iterator(disk_.folder())) {
        const std::string name = entry.path().filename();
        if (name.ends_with(ending) && name != "told.json") found.push_back(name);
      }
      return found;
    };
    const std::string draw = std::to_string(*expected_->accepted.begin());
    run_until({"export", "a.db", "--draw", draw, "--output", "."}, Work::file, 1, [&] {
      ++tally_.exports;
      for (const std::string& name : names(".json"))
        contents[name].insert(bytes_of_file(path(name)));
      return !last_.by_signal && last_.code == 0;
    });
    if (contents.empty()) return fail("export has written nothing");
    for (const auto& [name, versions] : contents) {
      if (versions.size() != 1) fail(name + " was half written");
    }
  }

  void tell(const Life& life) const {
    if (!cast_.tells) return;
    std::string text = fmt::format("  {}: {} ranks", kWorkNames[life.work], life.ranks);
    for (const Fault& fault : life.faults) {
      text += fmt::format(", {} at call {} for {}{}", kFaultNames[static_cast<int>(fault.kind)],
                          fault.at, fault.lasts, fault.after_call ? " after it" : "");
    }
    for (const Happening& happening : life.happenings) {
      text += fmt::format(", {} {} at {:.3f} s",
                          std::array{"signal", "silence", "visit"}[happening.kind],
                          happening.number, static_cast<double>(happening.at) / 1e9);
    }
    fmt::print("{}; {} {} after {} calls{}\n{}{}", text, last_.by_signal ? "signal" : "exit",
               last_.code, last_.calls, last_.lost_power ? ", power cut" : "", last_.err,
               last_.out);
  }

  Random random_;
  const Told told_;
  Disk& disk_;
  const Cast& cast_;
  Tally& tally_;
  Planner planner_;
  const Expected* expected_ = nullptr;
  const Share* share_ = nullptr;  // of the search that stands still
  std::string wrong_;
  std::map<std::string, Kept> kept_of_;  // of each catalogue
  Kept* kept_ = nullptr;                 // of the one that is written
  LifeEnd last_;
  std::uint64_t calls_before_ = 500;  // file calls of a life
  std::unique_ptr<Process> reader_, locker_;
  Circumstances circumstances_;
  bool was_disturbed_ = false, is_harmed_ = false, has_index_cut_ = false;
  bool has_copy_ = false;
  std::uint64_t done_before_ = 0, draws_to_find_ = 0;
  int least_runs_ = 0;  // with which a catalogue shows what a power cut must not undo
};

}  // namespace

std::string play(std::uint64_t seed, Disk& disk, const Cast& cast, Tally& tally, int& planned) {
  planned = 0;
  try {
    return Story(seed, disk, cast, tally, planned).play();
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace misalign::simulation
