#include "schema/catalogue/weighted_count.hpp"

#include <algorithm>

namespace misalign::schema {

WeightedCount WeightedCount::of(std::uint64_t rows, double weight) {
  const auto n = static_cast<double>(rows);
  return {rows, n * weight, n * weight * weight};
}

WeightedCount& WeightedCount::operator+=(const WeightedCount& other) {
  rows += other.rows;
  draws += other.draws;
  squares += other.squares;
  return *this;
}

double share(const WeightedCount& part, const WeightedCount& all) {
  return all.draws > 0 ? std::min(part.draws / all.draws, 1.0) : 0;
}

ShareInterval share_interval(const WeightedCount& part, const WeightedCount& all) {
  const double trials = all.effective();
  if (part.rows == 0) return share_interval_of(0, trials);
  if (part.rows == all.rows) return share_interval_of(trials, trials);
  return share_interval_of(share(part, all) * trials, trials);
}

}  // namespace misalign::schema
