// One population on its way up: which particles are done, given out and open at its level, and who
// goes on from there; and behind its last level the sheets that it starts ascents from. A pure
// state machine, without clock, file or message.
#pragma once

#include "search/splitting/found_candidates.hpp"
#include "search/splitting/ladder.hpp"
#include "search/splitting/level_pieces.hpp"

namespace misalign::search {

struct PopulationRecord {
  std::uint32_t population;
  std::vector<schema::LevelCount>
      levels;  ///< from 0 on, as far as it came; the last level's has none after
  /// By their origins, each sheet once; not all if so wanted. Of starts where they end.
  std::vector<FoundCandidate> found;

  double share(std::uint32_t level) const { return schema::share_reaching(level, levels); }
};

class Population {
 public:
  /// `ladder` must outlive this object. `most_found`: so many sheets are kept, those with the least
  /// origins; all are counted.
  Population(const Ladder& ladder, std::uint32_t number, std::uint64_t most_found = kAllSheets);

  std::uint32_t number() const { return number_; }
  std::uint32_t level() const { return level_; }
  /// The next particles of its level that are open, at most so many, now given out; of starts one.
  std::optional<PieceOrder> take(std::uint32_t most);
  /// What has come back of an order that ended at this particle; what it leaves of that is open
  /// again. True if it ended the level.
  bool add(std::uint32_t end_of_order, PieceResult result);
  /// What an earlier run has done. False if it does not belong to the level that this one is at, or
  /// says of particles that they survived that cannot have.
  bool restore(PieceResult result);
  bool is_at_first() const { return level_ == 0; }
  bool is_at_ends() const { return level_ == ladder_.of_ends(); }
  bool is_done() const { return is_done_; }
  /// Particles of its level that nobody has.
  std::uint64_t open() const { return pieces_.open(); }
  /// Once it is done.
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
  ScoredParticles here_;  // at its level
  std::vector<std::uint32_t> ancestors_;
  FoundCandidates found_;
  PopulationRecord record_;
};

}  // namespace misalign::search
