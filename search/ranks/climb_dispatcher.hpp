// Assigns particles of populations to ranks: a pure state machine, without clock, file or message.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "search/splitting/level_finder.hpp"
#include "search/splitting/population.hpp"

namespace misalign::search {

/// Hands out pieces of populations that are under way, the lowest first, and begins the next one
/// where none has any left: so ranks wait for each other at the end of a population only where
/// nothing else is to be done, and then its levels are cut into pieces for all of them.
class ClimbDispatcher {
 public:
  /// `ladder` without scores: a level finder finds them first.
  ClimbDispatcher(const Ladder& ladder, int last_score, Ledger populations, int workers,
                  std::uint64_t most_found = kAllSheets);

  ClimbDispatcher(const ClimbDispatcher&) = delete;
  ClimbDispatcher& operator=(const ClimbDispatcher&) = delete;

  /// What an earlier run did of a population under way, or of the level finder. False if it is no
  /// use: then it will be done again.
  bool restore(PieceResult result);
  std::optional<PieceOrder> assign(int worker);
  void finish(int worker, PieceResult result);
  bool has_job(int worker) const { return workers_[worker].population.has_value(); }

  /// Populations that have come to their end since this was last asked.
  std::vector<PopulationRecord> take_done();
  /// The levels, once they are known; and whether the level finder has found them since this was
  /// last asked.
  const Ladder& ladder() const { return ladder_; }
  bool take_news_of_levels() { return std::exchange(has_news_of_levels_, false); }

  /// The goal ends here now: populations from this one on are wanted no more.
  void cut(std::uint64_t end);
  bool complete() const { return !level_finder_ && populations_.complete(); }
  bool anything_open() const;
  /// Populations that are not done.
  std::uint64_t populations_left() const {
    return populations_.open_draws() + populations_.draws_given_out();
  }
  /// "population 3 at level 5 of 12", of the lowest that is under way.
  std::string under_way() const;

 private:
  struct Worker {
    std::optional<std::uint32_t> population;  // that it works for
    std::uint32_t end = 0;                    // of its order
    bool is_first = false, is_at_ends = false;
    double first_per_s = 0, particles_per_s = 0;  // of its last pieces
  };
  template <class Climb>
  std::optional<PieceOrder> take(Climb& climb, Worker& worker);
  std::uint32_t piece_size(const Worker& worker, bool is_first, std::uint64_t open) const;
  void look_at_end(std::uint32_t number);
  Population* begin(std::uint32_t number);

  Ladder ladder_;
  Ledger populations_;
  std::uint64_t end_ = schema::kEndOfPopulations;  // above what is wanted
  std::optional<LevelFinder> level_finder_;
  bool has_news_of_levels_ = false;
  std::map<std::uint32_t, Population> climbing_;
  std::vector<PopulationRecord> done_;
  std::vector<Worker> workers_;
  std::uint64_t most_found_;  // of each population
};

}  // namespace misalign::search
