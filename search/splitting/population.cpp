#include "search/splitting/population.hpp"

#include <algorithm>
#include <cassert>
#include <set>

namespace misalign::search {

double PopulationRecord::share(std::uint32_t level) const {
  double share = 1;
  for (std::uint32_t k = 0; k < level; ++k) {
    if (k >= levels.size()) return 0;
    share *= static_cast<double>(levels[k].survivors) / levels[k].particles;
  }
  return share;
}

Population::Population(const Ladder& ladder, std::uint32_t number)
    : ladder_(ladder), number_(number), pieces_(0, ladder.first_draws) {
  record_.population = number;
}

std::optional<PieceOrder> Population::take(std::uint32_t most) {
  const auto range = pieces_.take(most);
  if (!range) return std::nullopt;
  PieceOrder order{
      number_, level_, range->lo, range->hi, ladder_.score(level_), ladder_.next(level_),
      true,    {},     {}};
  if (level_ == 0) return order;
  for (std::uint32_t k = range->lo; k < range->hi; ++k) {
    order.sheets.add(std::as_const(sheets_)[k]);
    order.scores.push_back(scores_[k]);
  }
  return order;
}

bool Population::add(std::uint32_t end_of_order, PieceResult result) {
  assert(result.level == level_);
  const LevelPieces::Range range{result.lo, end_of_order};
  if (!pieces_.add(range, std::move(result))) return false;
  end_level(pieces_.all());
  return true;
}

PopulationRecord Population::record() {
  assert(is_done_);
  std::ranges::sort(record_.found, {}, &FoundSheet::origin);
  std::set<std::vector<double>> seen;
  std::erase_if(record_.found, [&](const FoundSheet& found) {
    const Eigen::Matrix2Xd& shifts_mm = found.candidate.shifts_mm;
    return !seen.insert({shifts_mm.data(), shifts_mm.data() + shifts_mm.size()}).second;
  });
  return std::move(record_);
}

void Population::end_level(PieceResult all) {
  std::vector<std::uint32_t> ancestors;
  for (const std::uint32_t particle : all.survivors) {
    ancestors.push_back(level_ == 0 ? particle : ancestors_[particle]);
  }
  const auto survivors = static_cast<std::uint32_t>(all.survivors.size());
  const std::set<std::uint32_t> different(ancestors.begin(), ancestors.end());
  record_.levels.push_back({level_, ladder_.size(level_), survivors,
                            static_cast<std::uint32_t>(different.size()), all.tried, all.taken,
                            all.undecided, 0, all.seconds});
  for (MetCandidate& met : all.met) {
    record_.found.push_back({{number_, level_, met.step, met.particle}, std::move(met.candidate)});
  }
  is_done_ = survivors == 0;  // it died, or there is nowhere to go on to
  if (is_done_) return;
  ++level_;
  sheets_.clear();
  scores_.clear();
  ancestors_.clear();
  for (const std::uint32_t k :
       copies_of_survivors(ladder_.seed, number_, level_, survivors, ladder_.particles)) {
    sheets_.add(std::as_const(all.sheets)[k]);
    scores_.push_back(all.scores[k]);
    ancestors_.push_back(ancestors[k]);
  }
  pieces_ = LevelPieces(0, ladder_.particles);
}

}  // namespace misalign::search
