#include "search/splitting/level_finder.hpp"

#include <algorithm>
#include <cassert>
#include <functional>

#include "schema/campaign/climb_cost.hpp"

namespace misalign::search {
namespace {

// Repetitions of a level before the level finder gives up.
constexpr std::uint32_t kMostTries = 20;

// Returns the largest score that at least `rank` of these reach.
int score_of_rank(std::vector<int> scores, std::size_t rank) {
  assert(!scores.empty());
  const std::size_t place = std::min(std::max<std::size_t>(rank, 1), scores.size()) - 1;
  std::ranges::nth_element(scores, scores.begin() + static_cast<std::ptrdiff_t>(place),
                           std::greater());
  return scores[place];
}

}  // namespace

LevelFinder::LevelFinder(std::uint64_t seed, std::uint32_t particles, std::uint32_t first_draws,
                         int last)
    : ladder_{seed, {}, particles, first_draws},
      last_(last),
      size_(std::min(particles, kMostParticles)),
      looked_at_(std::min(particles, first_draws)),
      pieces_(std::min(particles, first_draws)) {}

std::optional<PieceOrder> LevelFinder::take(std::uint32_t most) {
  const auto particles = pieces_.take(most);
  if (!particles) return std::nullopt;
  // The scores of all particles are needed.
  const RungBounds bounds{reached(), least_score()};
  PieceOrder order = order_of(kNumber, level_, *particles, bounds, here_);
  order.is_catalogued = false;
  return order;
}

bool LevelFinder::restore(PieceResult result) {
  const bool is_of_level =
      !is_done_ && result.level == level_ && result.are_all_from(least_score());
  if (!is_of_level || !pieces_.take({result.lo, result.hi})) return false;
  const std::uint32_t end = result.hi;
  add(end, std::move(result));
  return true;
}

bool LevelFinder::add(std::uint32_t end_of_order, PieceResult result) {
  const DrawRange taken{result.lo, end_of_order};
  if (!pieces_.add(taken, std::move(result))) return false;
  end_level(pieces_.all());
  return true;
}

void LevelFinder::end_level(const PieceResult& all) {
  if (all.there.scores.empty()) {
    end(false);
  } else if (looked_at_ < ladder_.first_draws) {
    // Takes up to ten times as many first draws; as many survivors as now are enough.
    const std::uint64_t now = looked_at_;
    looked_at_ = std::min(10 * now, std::uint64_t{ladder_.first_draws});
    from_ = std::min(last_,
                     score_of_rank(all.there.scores, all.there.scores.size() * now / looked_at_));
    ++level_;
    pieces_ = LevelPieces(static_cast<std::uint32_t>(looked_at_));
  } else {
    const std::size_t rank = here_.count() == 0
                                 ? ladder_.particles / 2
                                 : static_cast<std::size_t>(schema::kShareOfLevel * size_);
    go_on_from(std::min(last_, score_of_rank(all.there.scores, rank)), all);
  }
}

void LevelFinder::go_on_from(int score, const PieceResult& all) {
  const int reached = this->reached();
  if (score <= reached) {  // for ties: the next higher score, if any
    score = last_;
    bool is_there = false;
    for (const int higher : all.there.scores) {
      if (higher <= reached) continue;
      score = std::min(score, higher);
      is_there = true;
    }
    if (!is_there && ++tries_ > kMostTries) {
      end(false);
      return;
    }
    if (!is_there) score = reached;
  }
  if (score < last_ && ladder_.scores.size() + 1 >= schema::kMostLevels) {
    end(false);
    return;
  }
  if (score > reached) {
    ladder_.scores.push_back(score);
    tries_ = 0;
  }
  if (score == last_) {
    end(true);
    return;
  }
  ScoredParticles above;
  for (std::size_t k = 0; k < all.there.count(); ++k) {
    if (all.there.scores[k] >= score) above.add(all.there, k);
  }
  ++level_;
  here_.clear();
  for (const std::uint32_t k : copies_of_survivors(
           ladder_.seed, kNumber, level_, static_cast<std::uint32_t>(above.count()), size_)) {
    here_.add(above, k);
  }
  pieces_ = LevelPieces(size_);
}

void LevelFinder::end(bool is_whole) {
  is_done_ = true;
  is_whole_ = is_whole;
  if (ladder_.scores.empty() || ladder_.scores.back() < last_) ladder_.scores.push_back(last_);
}

}  // namespace misalign::search
