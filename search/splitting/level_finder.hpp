// Finds the levels of a campaign that names none. Its particles enter no estimate and no catalogue.
#pragma once

#include <optional>

#include "search/splitting/ladder.hpp"
#include "search/splitting/level_pieces.hpp"

namespace misalign::search {

/// A population of its own number, whose levels are chosen as it goes, by the scores of its
/// particles: the first so that about half as many first draws as there are particles reach it, the
/// others so that one particle in five does. Populations keep these levels as they are.
class LevelFinder {
 public:
  static constexpr std::uint32_t kNumber = 0xFFFFFFFF;
  /// More say little more of where levels are to lie.
  static constexpr std::uint32_t kMostParticles = 10000;

  /// `last`: the score of the last level.
  LevelFinder(std::uint64_t seed, std::uint32_t particles, std::uint32_t first_draws, int last);

  /// As of a Population.
  std::optional<PieceOrder> take(std::uint32_t most);
  bool add(std::uint32_t end_of_order, PieceResult result);
  bool restore(PieceResult result);
  std::uint64_t open() const { return pieces_.open(); }
  std::uint32_t level() const { return level_; }
  bool is_at_first() const { return here_.count() == 0; }
  /// Whether the last level is reached, or none higher is.
  bool is_done() const { return is_done_; }
  /// Once it is done, of populations: ascending, the last one `last` whether it was reached or not.
  const Ladder& ladder() const { return ladder_; }
  /// Whether it came to the last level: otherwise few populations will, or none.
  bool is_whole() const { return is_whole_; }

 private:
  void end_level(const PieceResult& all);
  void go_on_from(int score, const PieceResult& all);
  void end(bool is_whole);
  // That of the particles which are looked at.
  int least_score() const { return here_.count() == 0 ? from_ : reached(); }
  int reached() const { return ladder_.scores.empty() ? 0 : ladder_.scores.back(); }

  Ladder ladder_;
  const int last_;
  const std::uint32_t size_;  // its particles
  std::uint32_t level_ = 0;   // at first ever more of the first draws
  int from_ = 0;              // the score from which on first draws are looked at
  std::uint64_t looked_at_;   // of the first draws
  std::uint32_t tries_ = 0;   // steps of this level without a higher one
  bool is_done_ = false, is_whole_ = false;
  LevelPieces pieces_;
  ScoredParticles here_;
};

}  // namespace misalign::search
