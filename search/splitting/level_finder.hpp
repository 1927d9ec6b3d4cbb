// Finds the levels of a campaign that names none. Its particles enter no estimate and no catalogue.
#pragma once

#include <optional>

#include "search/splitting/ladder.hpp"
#include "search/splitting/level_pieces.hpp"

namespace misalign::search {

/// A population with a number of its own, which chooses its levels by the scores of its particles.
/// The first level is reached by about half as many first draws as there are particles, every other
/// level by one particle in five. Populations use these levels unchanged.
class LevelFinder {
 public:
  static constexpr std::uint32_t kNumber = 0xFFFFFFFF;
  /// Largest number of particles: more would hardly change the levels.
  static constexpr std::uint32_t kMostParticles = 10000;

  /// `last`: the score of the last level.
  LevelFinder(std::uint64_t seed, std::uint32_t particles, std::uint32_t first_draws, int last);

  /// These three work as those of a Population.
  std::optional<PieceOrder> take(std::uint32_t most);
  bool add(std::uint32_t end_of_order, PieceResult result);
  bool restore(PieceResult result);
  std::uint64_t open() const { return pieces_.open(); }
  std::uint32_t level() const { return level_; }
  bool is_at_first() const { return here_.count() == 0; }
  /// Returns whether the last level is reached, or no higher one can be.
  bool is_done() const { return is_done_; }
  /// Returns the populations' ladder, once it is done: ascending up to `last`, reached or not.
  const Ladder& ladder() const { return ladder_; }
  /// Returns whether it reached the last level; otherwise few populations will, or none.
  bool is_whole() const { return is_whole_; }

 private:
  void end_level(const PieceResult& all);
  void go_on_from(int score, const PieceResult& all);
  void end(bool is_whole);
  // The least score of particles that are reported.
  int least_score() const { return here_.count() == 0 ? from_ : reached(); }
  int reached() const { return ladder_.scores.empty() ? 0 : ladder_.scores.back(); }

  Ladder ladder_;
  const int last_;
  const std::uint32_t size_;  // number of its particles
  std::uint32_t level_ = 0;   // the first ones look at ever more first draws
  int from_ = 0;              // least score of first draws that are reported
  std::uint64_t looked_at_;   // number of first draws
  std::uint32_t tries_ = 0;   // repetitions of this level without a higher one
  bool is_done_ = false, is_whole_ = false;
  LevelPieces pieces_;
  ScoredParticles here_;
};

}  // namespace misalign::search
