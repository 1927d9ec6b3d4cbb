#include "schema/catalogue/weighted_count.hpp"

#include <algorithm>

#include "schema/catalogue/database.hpp"
#include "schema/records/fault_sample.hpp"

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

WeightedCount sampled_rows(const SQLite::Database& database, const SQLite::Column& rows,
                           const SQLite::Column& weight) {
  constexpr auto kLeast = static_cast<double>(kFaultSampleEvery);
  const double draws = weight.getDouble();
  if (!(draws >= kLeast)) {
    throw damaged(database, "a row of fault_sample stands for " + shown_number(draws) +
                                " draws, where none stands for fewer than " + shown_number(kLeast));
  }
  return WeightedCount::of(draw_of(rows), draws);
}

}  // namespace misalign::schema
