#include "solver/motion/stress.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::solver {

void StressStudy::end_where_deployed(double flat_deg) {
  assert(flat_deg > 0);
  const auto deployed = std::find_if(rows.begin(), rows.end(),
                                     [&](const Row& row) { return row.widest_deg < flat_deg; });
  if (deployed == rows.end()) return;
  deployed_s = deployed->time_s;
  rows.erase(deployed + 1, rows.end());
}

std::optional<double> StressStudy::rigid_pilot_deg(double time_s) const {
  const auto after = std::find_if(rigid.begin(), rigid.end(),
                                  [&](const auto& row) { return row.time_s >= time_s; });
  if (after == rigid.end()) return {};
  if (after == rigid.begin()) return after->pilot_deg;
  // The angle is on the cubic through both rows with their rates.
  const auto& before = *(after - 1);
  const double h = after->time_s - before.time_s, s = (time_s - before.time_s) / h;
  assert(h > 0 && s >= 0 && s <= 1);
  return before.pilot_deg * (1 + 2 * s) * (1 - s) * (1 - s) +
         after->pilot_deg * s * s * (3 - 2 * s) +
         h * s * (1 - s) * (before.rate_deg_per_s * (1 - s) - after->rate_deg_per_s * s);
}

}  // namespace misalign::solver
