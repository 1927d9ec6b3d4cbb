#include "schema/catalogue/yield_check.hpp"

#include <cmath>

#include "schema/catalogue/yield.hpp"

namespace misalign::schema {
namespace {

// Another library's quantiles may differ in their last digits.
bool agree(const Json& stored, const Json& recomputed) {
  constexpr double kLastDigits = 1e-9;
  if (stored.is_null() || recomputed.is_null()) return stored == recomputed;
  return std::abs(stored.get<double>() - recomputed.get<double>()) <= kLastDigits;
}

}  // namespace

std::vector<Finding> check_yields(SQLite::Database& database) {
  std::vector<Finding> findings;
  SQLite::Statement row(database,
                        "SELECT yield.draw, amplitude_mm, trials, survivors, undecided, share, "
                        "share_low, share_high, candidate.draw IS NOT NULL, from_deg "
                        "FROM yield LEFT JOIN candidate USING (draw) "
                        "ORDER BY yield.draw, amplitude_mm, from_deg");
  while (row.executeStep()) {
    const Yield yield{draw_of(row.getColumn(0)), row.getColumn(1).getDouble(),
                      draw_of(row.getColumn(2)), draw_of(row.getColumn(3)),
                      draw_of(row.getColumn(4)), {}};
    const std::string where = "draw " + std::to_string(yield.draw) + ", copies off by " +
                              shown_number(yield.amplitude_mm) + " mm, from " +
                              shown_number(row.getColumn(9).getDouble()) + " deg";
    if (row.getColumn(8).getInt() == 0) {
      findings.push_back(differs(where, "yield.draw", yield.draw, "a candidate's"));
    }
    if (!yield.adds_up()) {
      findings.push_back(differs(where, "yield.survivors", row.getColumn(3).getInt64(),
                                 "at most trials less undecided"));
      continue;
    }
    const Json recomputed = yield_json(yield);
    const char* const kShares[] = {"share", "share_low", "share_high"};
    for (int k = 0; k < 3; ++k) {
      const SQLite::Column cell = row.getColumn(5 + k);
      const Json stored = cell.isNull() ? Json() : Json(cell.getDouble());
      if (agree(stored, recomputed[kShares[k]])) continue;
      findings.push_back(
          differs(where, std::string("yield.") + kShares[k], stored, recomputed[kShares[k]]));
    }
  }
  return findings;
}

}  // namespace misalign::schema
