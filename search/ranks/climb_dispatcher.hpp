// Assigns particles of populations to ranks: a pure state machine, without clock, file or message.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "search/splitting/level_finder.hpp"
#include "search/splitting/population.hpp"

namespace misalign::search {

/// Hands out pieces of populations under way, the lowest first, and begins the next population when
/// none has an open piece. So ranks wait for each other at the end of a population only if there is
/// no other work; then its levels are cut into pieces for all of them.
class ClimbDispatcher {
 public:
  /// Starts with a level finder if `ladder` has no scores.
  ClimbDispatcher(const Ladder& ladder, int last_score, Ledger populations, int workers,
                  std::uint64_t most_found = kAllSheets);

  ClimbDispatcher(const ClimbDispatcher&) = delete;
  ClimbDispatcher& operator=(const ClimbDispatcher&) = delete;

  /// Takes an earlier run's result of a population under way, or of the level finder. Returns false
  /// if it is unusable: then it will be done again.
  bool restore(PieceResult result);
  std::optional<PieceOrder> assign(int worker);
  void finish(int worker, PieceResult result);
  bool has_job(int worker) const { return workers_[worker].population.has_value(); }

  /// Returns the populations that have ended since the last call.
  std::vector<PopulationRecord> take_done();
  /// Returns the levels, once they are known; the second, true if the level finder has found them
  /// since the last call.
  const Ladder& ladder() const { return ladder_; }
  bool take_news_of_levels() { return std::exchange(has_news_of_levels_, false); }

  /// Ends the goal at `end`: populations from this one on are not needed any more.
  void cut(std::uint64_t end);
  bool complete() const { return !level_finder_ && populations_.complete(); }
  bool anything_open() const;
  /// Counts populations that are not done.
  std::uint64_t populations_left() const {
    return populations_.open_draws() + populations_.draws_given_out();
  }
  /// Describes the lowest population under way: "population 3 at level 5 of 12".
  std::string under_way() const;

 private:
  struct Worker {
    std::optional<std::uint32_t> population;  // population of its order
    std::uint32_t end = 0;                    // end of its order
    bool is_first = false, is_at_ends = false;
    double first_per_s = 0, particles_per_s = 0;  // speeds of its last pieces
  };
  template <class Climb>
  std::optional<PieceOrder> take(Climb& climb, Worker& worker);
  std::uint32_t piece_size(const Worker& worker, bool is_first, std::uint64_t open) const;
  void look_at_end(std::uint32_t number);
  Population* begin(std::uint32_t number);

  Ladder ladder_;
  Ledger populations_;
  std::uint64_t end_ = schema::kEndOfPopulations;  // end of the goal
  std::optional<LevelFinder> level_finder_;
  bool has_news_of_levels_ = false;
  std::map<std::uint32_t, Population> climbing_;
  std::vector<PopulationRecord> done_;
  std::vector<Worker> workers_;
  std::uint64_t most_found_;  // candidates kept of each population
};

}  // namespace misalign::search
