#include "search/splitting/population.hpp"

#include <algorithm>
#include <cassert>
#include <set>
#include <utility>

namespace misalign::search {

Population::Population(const Ladder& ladder, std::uint32_t number, std::uint64_t most_found)
    : ladder_(ladder),
      number_(number),
      pieces_(ladder.first_draws),
      met_(ladder.starts > 0 ? std::min<std::uint64_t>(ladder.starts, most_found) : most_found) {
  record_.population = number;
}

std::optional<PieceOrder> Population::take(std::uint32_t most) {
  const auto particles = pieces_.take(is_at_ends() ? 1 : most);  // an ascent takes seconds
  if (!particles) return std::nullopt;
  if (is_at_ends()) {
    PieceOrder order = order_of(number_, level_, *particles, {0, kBeyondAll}, {});
    order.is_first = false;
    order.starts = {record_.found[particles->lo].candidate};
    return order;
  }
  return order_of(number_, level_, *particles, {ladder_.score(level_), ladder_.next(level_)},
                  here_);
}

bool Population::add(std::uint32_t end_of_order, PieceResult result) {
  assert(result.level == level_);
  for (MetCandidate& met : std::exchange(result.met, {})) {
    if (is_at_ends()) {
      record_.found[met.particle].candidate = std::move(met.candidate);
      continue;
    }
    met_.add({number_, level_, met.step, met.particle}, std::move(met.candidate));
  }
  const DrawRange taken{result.lo, end_of_order};
  if (!pieces_.add(taken, std::move(result))) return false;
  end_level(pieces_.all());
  return true;
}

bool Population::is_of_level(const PieceResult& result) const {
  if (is_done_ || result.level != level_) return false;
  for (const MetCandidate& met : result.met) {
    if (met.candidate.ascent.has_value() != is_at_ends()) return false;
  }
  if (level_ < ladder_.top()) return result.are_all_from(ladder_.next(level_));
  return result.survivors.empty() && (!is_at_ends() || result.has_one_each());
}

bool Population::restore(PieceResult result) {
  if (!is_of_level(result) || !pieces_.take({result.lo, result.hi})) return false;
  const std::uint32_t end = result.hi;
  add(end, std::move(result));
  return true;
}

PopulationRecord Population::record() {
  assert(is_done_);
  return std::move(record_);
}

void Population::end_level(const PieceResult& all) {
  if (is_at_ends()) {
    record_.levels.back().seconds += all.seconds;
    is_done_ = true;
    return;
  }
  std::vector<std::uint32_t> ancestors;
  for (const std::uint32_t particle : all.survivors) {
    assert(level_ == 0 || particle < ancestors_.size());
    ancestors.push_back(level_ == 0 ? particle : ancestors_[particle]);
  }
  const auto survivors = static_cast<std::uint32_t>(all.survivors.size());
  assert(all.there.scores.size() == all.survivors.size());
  const std::set<std::uint32_t> different(ancestors.begin(), ancestors.end());
  record_.levels.push_back({level_, ladder_.size(level_), survivors,
                            static_cast<std::uint32_t>(different.size()), all.tried, all.taken,
                            all.undecided, 0, all.seconds});
  if (survivors == 0) return end_climb();  // no survivors, or no further level
  ++level_;
  here_.clear();
  here_.reserve(ladder_.particles, all.there.sheets.bytes_each);
  ancestors_.clear();
  ancestors_.reserve(ladder_.particles);
  for (const std::uint32_t k :
       copies_of_survivors(ladder_.seed, number_, level_, survivors, ladder_.particles)) {
    here_.add(all.there, k);
    ancestors_.push_back(ancestors[k]);
  }
  pieces_ = LevelPieces(ladder_.particles);
}

void Population::end_climb() {
  met_.count(record_.levels);
  record_.found = met_.take();
  is_done_ = ladder_.starts == 0 || record_.found.empty();
  if (is_done_) return;
  level_ = ladder_.of_ends();
  here_ = {};
  pieces_ = LevelPieces(static_cast<std::uint32_t>(record_.found.size()));
}

}  // namespace misalign::search
