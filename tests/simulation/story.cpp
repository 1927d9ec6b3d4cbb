#include "tests/simulation/story.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "tests/simulation/visitors.hpp"

namespace misalign::simulation {
namespace {

using schema::Json;

bool is_done_well(const LifeEnd& end) { return !end.by_signal && end.code == 0; }

class Story {
 public:
  Story(std::uint64_t seed, Disk& disk, const Cast& cast, Tally& tally, int& planned)
      : random_(seed),
        told_(told_by(seed, random_)),
        cast_(cast),
        planner_(told_, cast, planned),
        scene_{told_, disk, tally} {}

  std::string play() {
    set_tempo(told_.tempo);
    scene_.expected = &expected_of(told_, scene_.disk);
    scene_.disk.clear();
    scene_.disk.put("told.json", told_.file.dump());
    ++scene_.tally.seeds;
    scene_.tally.migrations += told_.older_version > 0;
    scene_.tally.real_seeds += told_.tempo.is_real;
    const bool has_fixed_end = !told_.campaign.stop.accepted;  // whatever a file holds
    const bool is_divided =
        told_.older_version == 0 && has_fixed_end && told_.goal > 2 && happens(random_, 0.12);
    if (is_divided) {
      const std::uint64_t middle = 1 + up_to(random_, told_.goal - 1);
      const std::uint64_t overlap = up_to(random_, 1 + std::min(middle, told_.goal / 4));
      live_through({"a.db", 0, middle});
      live_through({"b.db", middle - overlap, told_.goal});
    } else {
      live_through({"a.db", 0, told_.goal});
    }
    if (is_divided || (has_copy_ && has_fixed_end)) merge();
    if (is_divided) return scene_.wrong;
    ToldFile& file = files_.at("a.db");
    expect_finished(file, false);
    if (scene_.expected->accepted.empty()) return scene_.wrong;
    if (told_.kind == "plain" && happens(random_, 0.06)) study(file);
    // Its candidates are real ones.
    if (told_.older_version && !told_.is_split && happens(random_, 0.3)) export_candidate();
    return scene_.wrong;
  }

 private:
  ToldFile& new_file(const std::string& name) {
    return files_.try_emplace(name, scene_, name, ToldFile::Begins::told).first->second;
  }

  void live_through(Share share) {
    if (!scene_.wrong.empty()) return;
    ToldFile& file = new_file(share.file);
    calls_before_ = kUsualCalls;
    const auto faulty = static_cast<int>(up_to(random_, 5));
    share.on_network = happens(random_, 0.1);
    constexpr int kMostCleanLives = 3;
    for (int life = 0; scene_.wrong.empty(); ++life) {
      Random of_life(random_());
      const bool is_faulty = life < std::min(faulty, cast_.most_faulty_lives);
      if (life >= faulty + kMostCleanLives) {
        return scene_.fail("it comes to no end: " + last_.err);
      }
      const Planned planned = planner_.search(share, is_faulty, calls_before_, of_life);
      const std::uint64_t made = live(planned, share, file, of_life);
      if (is_complete(planned, file)) return;
      if (is_faulty && happens(of_life, 0.06) && planner_.is_in()) file.harm(of_life);
      const Json seen = file.look_after(last_, made);
      const bool has_candidates = !seen.value("accepted", Json::array()).empty();
      const bool can_be_studied = told_.kind == "plain" || told_.kind == "splitting";
      const double often = told_.is_split ? 0.4 : 0.15;
      if (has_candidates && can_be_studied && !file.is_harmed() && happens(of_life, often)) {
        study(file);
      }
    }
  }

  // Runs a search once. Returns the draws that it has made if none may be lost, else 0.
  std::uint64_t live(const Planned& planned, const Share& share, ToldFile& file, Random& random) {
    circumstances_ = {};
    Visitors visitors(scene_, file, share, circumstances_, has_copy_);
    Process search(scene_.disk, planned.life);
    while (const auto visit = search.run_on()) {
      visitors.receive(static_cast<Visit>(*visit), random);
    }
    visitors.end();
    ended(planned.life, search.end(), random);
    scene_.tally.stops += planned.has_signal;
    scene_.tally.lost_ranks += planned.has_silence;
    const bool has_time = planned.is_drain || (planned.has_max_time && !planned.has_signal);
    const bool makes_plain_draws = told_.work == Work::unit || told_.kind == "certified";
    const bool is_calm = !circumstances_.was_disturbed && !planned.has_silence &&
                         !last_.by_signal && last_.errors == 0;
    return has_time && makes_plain_draws && is_calm ? last_.draws_made : 0;
  }

  // Counts a life, and lets a power cut have its effect; some come when nothing is under way.
  void ended(const Life& life, const LifeEnd& end, Random& random) {
    last_ = end;
    calls_before_ = std::max<std::uint64_t>(end.calls, 50);
    ++scene_.tally.lives;
    scene_.tally.kills += end.was_killed() && !end.lost_power;
    if (cast_.tells) fmt::print("{}", told_life(life, end));
    if (end.lost_power || happens(random, 0.05)) lose_power(random);
  }

  void lose_power(Random& random) {
    ++scene_.tally.power_cuts;
    scene_.disk.lose_power(random);
    for (auto& [name, file] : files_) file.lose_power();
  }

  // Compares the end of a search with the manual; returns whether the campaign is complete.
  bool is_complete(const Planned& planned, ToldFile& file) {
    const bool is_refused = contains(last_.err, "is missing") || contains(last_.err, "is damaged");
    if (file.is_harmed() && last_.code == 3 && is_refused) {
      file.take_refusal();
      return false;
    }
    const std::string what = unexplained(last_, planned, circumstances_, file.name());
    if (!what.empty()) {
      scene_.fail(fmt::format("{}: {} {}: {}{}", what, last_.by_signal ? "signal" : "exit code",
                              last_.code, last_.err, last_.out));
    }
    if (file.is_away()) file.put_back();
    const bool is_complete = says_complete(last_, file.name()) && last_.code == 0;
    const bool has_begun = contains(last_.out, file.name() + ": ");
    if (!is_complete && !ended_early(last_, planned, file.name())) return false;
    file.take_for_sound();
    if (has_begun && !circumstances_.was_disturbed) file.expect_alone();
    return is_complete;
  }

  void expect_finished(ToldFile& file, bool is_merged) {
    if (happens(random_, 0.1)) lose_power(random_);
    file.expect_finished(is_merged);
  }

  // Runs a verb, twice with faults, until it is done; whatever it leaves before must be good.
  void run_until(const std::vector<std::string>& words, Work work, int ranks,
                 const std::function<bool()>& is_done) {
    constexpr int kMostLives = 5;
    for (int life = 0; scene_.wrong.empty(); ++life) {
      Random random(random_());
      Life trying{program(words), ranks, random(), work};
      if (life < 2) planner_.add_faults(trying, calls_before_, random);
      ended(trying, run_through(scene_.disk, trying), random);
      if (is_done()) return;
      const bool says_why = !last_.by_signal && contains(last_.err, "misalign: ");
      const bool has_cause = last_.was_killed() || (last_.errors > 0 && says_why);
      if (!has_cause || life == kMostLives) {
        scene_.fail(words[0] + " is not done: " + last_.err);
      }
    }
  }

  // Joins the parts, and a copy of one; the output is whole as soon as it is there.
  void merge() {
    ++scene_.tally.merges;
    std::vector<std::string> words = {"merge", "all.db", "--allow-mixed-builds"};
    for (const auto& [name, file] : files_) words.push_back(name);
    if (has_copy_ && !told_.campaign.stop.accepted) words.push_back("copy.db");
    run_until(words, Work::merge, 1, [&] { return scene_.is_there("all.db"); });
    ToldFile all(scene_, "all.db", ToldFile::Begins::empty);
    for (const auto& [name, file] : files_) all.take_studies(file);
    expect_finished(all, true);
  }

  // Certificates and yields of the best candidates, by their verbs.
  void study(ToldFile& file) {
    const auto is_done = [&](std::uint64_t& runs) {
      ++runs;
      file.look_after(last_, 0);
      // A power cut may have taken what no search had synced.
      return is_done_well(last_) || contains(last_.err, "holds no such candidate");
    };
    if (happens(random_, 0.5)) {
      run_until({"certify", file.name(), "--best", "3"}, Work::certificate,
                std::min(planner_.ranks(random_), 3),
                [&] { return is_done(scene_.tally.certify_runs); });
    } else {
      run_until({"tolerance", file.name(), "--best", "2", "--amplitude", "0.05", "--trials", "40",
                 "--jobs", "1"},
                Work::yield, 1, [&] { return is_done(scene_.tally.yield_runs); });
    }
  }

  // Exports a candidate: each file is there as a whole, or not at all.
  void export_candidate() {
    std::map<std::string, std::set<std::string>> versions;
    const std::string draw = std::to_string(*scene_.expected->accepted.begin());
    run_until({"export", "a.db", "--draw", draw, "--output", "."}, Work::file, 1, [&] {
      ++scene_.tally.exports;
      for (const auto& entry : std::filesystem::directory_iterator(scene_.disk.folder())) {
        const std::string name = entry.path().filename();
        if (!name.ends_with(".json") || name == "told.json") continue;
        versions[name].insert(bytes_of_file(entry.path()));
      }
      return is_done_well(last_);
    });
    if (versions.empty()) return scene_.fail("export has written nothing");
    for (const auto& [name, bytes] : versions) {
      if (bytes.size() != 1) scene_.fail(name + " was half written");
    }
  }

  static constexpr std::uint64_t kUsualCalls = 500;

  Random random_;
  const Told told_;
  const Cast& cast_;
  Planner planner_;
  Scene scene_;
  std::map<std::string, ToldFile> files_;
  LifeEnd last_;
  std::uint64_t calls_before_ = kUsualCalls;  // file calls of the last life
  Circumstances circumstances_;
  bool has_copy_ = false;
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
