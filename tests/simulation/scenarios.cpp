#include "tests/simulation/scenarios.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "tests/simulation/campaigns.hpp"
#include "tests/simulation/process.hpp"

namespace misalign::simulation {
namespace {

using schema::Json;

// A campaign of 40 draws on one rank, again and again.
class Scenarios {
 public:
  explicit Scenarios(Disk& disk)
      : disk_(disk),
        told_((set_tempo(plain_story().tempo), plain_story())),
        expected_(expected_of(told_, disk)) {}

  bool play() {
    calls_ = (begin_anew(), search({}).calls);
    finished_and_cut();
    log_lost();
    sync_failed_and_cut();
    campaign_unreadable();
    return is_good_;
  }

 private:
  void expect(bool holds, const std::string& what, const LifeEnd& end = {}) {
    if (holds) return;
    is_good_ = false;
    fmt::print("scenario failed: {}: {} {}\n", what, end.code, end.err);
  }

  void begin_anew() {
    disk_.clear();
    disk_.put("told.json", told_.file.dump());
  }

  LifeEnd search(std::vector<Fault> faults) {
    auto words = told_.search_words("a.db", 0, told_.goal);
    words.insert(words.end(), {"--progress", "none", "--unit-draws", "5"});
    Life life{program(words)};
    life.faults = std::move(faults);
    const LifeEnd end = run_through(disk_, life);
    if (end.lost_power) disk_.lose_power(random_);
    return end;
  }

  bool is_there(const std::string& name) const {
    return ::access((disk_.folder() + "/" + name).c_str(), F_OK) == 0;
  }

  // Goes on to the end; the catalogue must hold what a plain loop finds.
  void expect_whole(const std::string& what) {
    const LifeEnd end = search({});
    const Json seen = answer_of(run_through(disk_, {looking_at("a.db", told_.campaign, nullptr)}));
    expect(end.code == 0 && Kept().take(seen, expected_, true).empty() &&
               seen["digest"] == expected_.digest,
           what, end);
  }

  // Seed 1266: a journal came back, and readers refused a finished catalogue.
  void finished_and_cut() {
    for (int trial = 0; trial < 30; ++trial) {
      begin_anew();
      search({});
      disk_.lose_power(random_);
      expect(is_there("a.db") && !is_there("a.db-journal") && !is_there("a.db-wal"),
             "a finished catalogue is one file after a power cut");
    }
  }

  // Seed 2871: some pages of a lost log had been folded in, and the search went on.
  void log_lost() {
    for (std::uint64_t call = 60; call < calls_; ++call) {
      begin_anew();
      search({{FaultKind::io_error, call, 1000}});
      ::unlink((disk_.folder() + "/a.db-wal").c_str());
      const LifeEnd end = search({});
      const bool is_refused =
          end.code == 3 && end.err.find("-wal, is missing") != std::string::npos;
      if (!is_refused) expect_whole(fmt::format("a log lost after a failure at call {}", call));
    }
  }

  // Seed 13424: the log's bytes were in memory, and never on the disk.
  void sync_failed_and_cut() {
    int trials = 0, cuts = 0;
    for (std::uint64_t call = 90; call < calls_; call += 6) {
      for (std::uint64_t next = 20; next < 70; next += 5) {
        begin_anew();
        search({{FaultKind::failed_sync, call, 1000}});
        ++trials;
        cuts += search({{FaultKind::power_cut, next}}).lost_power;
        expect_whole(
            fmt::format("a sync failed at call {}, then the power at call {}", call, next));
      }
    }
    expect(2 * cuts > trials, fmt::format("{} of {} searches lost their power", cuts, trials));
  }

  // Seed 158: a campaign on a failing disk was called missing.
  void campaign_unreadable() {
    begin_anew();
    const LifeEnd end = search({{FaultKind::io_error, 1}});
    expect(end.code == 1 && end.err.find("Input/output error") != std::string::npos,
           "a campaign that the disk cannot open", end);
  }

  Disk& disk_;
  const Told told_;
  const Expected& expected_;
  Random random_{60};
  std::uint64_t calls_ = 0;
  bool is_good_ = true;
};

}  // namespace

bool play_scenarios(Disk& disk) { return Scenarios(disk).play(); }

}  // namespace misalign::simulation
