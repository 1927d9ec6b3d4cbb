// Moves one population up the ladder: particles that are done, given out and open at its level, the
// survivors, and after the last level the starts of ascents. A pure state machine, without clock,
// file or message.
#pragma once

#include "search/splitting/found_candidates.hpp"
#include "search/splitting/ladder.hpp"
#include "search/splitting/level_pieces.hpp"

namespace misalign::search {

struct PopulationRecord {
  std::uint32_t population;
  std::vector<schema::LevelCount> levels;  ///< levels 0 to the last one reached
  /// Kept sheets by their origins, each once; for starts their optima.
  std::vector<FoundCandidate> found;

  double share(std::uint32_t level) const { return schema::share_reaching(level, levels); }
};

class Population {
 public:
  /// `ladder` must outlive this object. The `most_found` sheets with the smallest origins are kept;
  /// all are counted.
  Population(const Ladder& ladder, std::uint32_t number, std::uint64_t most_found = kAllSheets);

  std::uint32_t number() const { return number_; }
  std::uint32_t level() const { return level_; }
  /// Gives out the next open particles of its level, at most `most`; one if they are starts.
  std::optional<PieceOrder> take(std::uint32_t most);
  /// Takes the result of an order that ended at this particle; the rest of it is open again.
  /// Returns true if that ended the level.
  bool add(std::uint32_t end_of_order, PieceResult result);
  /// Takes an earlier run's result. Returns false if it is of another level, or has survivors whose
  /// scores are too low.
  bool restore(PieceResult result);
  bool is_at_first() const { return level_ == 0; }
  bool is_at_ends() const { return level_ == ladder_.of_ends(); }
  bool is_done() const { return is_done_; }
  /// Returns the number of open particles of its level.
  std::uint64_t open() const { return pieces_.open(); }
  /// Returns the record, once it is done.
  PopulationRecord record();

 private:
  bool is_of_level(const PieceResult& result) const;
  void end_level(const PieceResult& all);
  void end_climb();

  const Ladder& ladder_;
  const std::uint32_t number_;
  std::uint32_t level_ = 0;
  bool is_done_ = false;
  LevelPieces pieces_;
  ScoredParticles here_;  // particles of its level
  std::vector<std::uint32_t> ancestors_;
  FoundCandidates met_;
  PopulationRecord record_;
};

}  // namespace misalign::search
