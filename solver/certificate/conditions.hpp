// The conditions that must stay positive all along a path: every diagonal's rate of change in its
// direction or the energy's, and the cosine and, by its mountain or valley, the sine of half of
// every crease's fold angle.
#pragma once

#include <algorithm>
#include <vector>

#include "solver/certificate/tube_prover.hpp"

namespace misalign::solver {

struct Condition {
  CertificateEnd broken;  ///< end where this is negative: reversal, over_folded, sign_changed
  int where;              ///< diagonal or crease
  PathModel value;        ///< all over a tube
};

/// `slopes`: of each diagonal, or of the energy alone; `directions`: +1 or -1 for each.
std::vector<Condition> conditions_of(const Mechanism& mechanism, const PathTube& tube,
                                     const std::vector<PathModel>& slopes,
                                     const std::vector<int>& directions);

/// The largest s, up to `end`, up to which `holds(from, to)` is true for all parts from s = -1 on.
/// Parts are halved until they are no longer than `resolution`; their number is limited.
template <class Holds>
double holds_until(const Holds& holds, double end, double resolution) {
  constexpr int kMostParts = 100000;
  double from = -1, step = 2;
  for (int parts = 0; from < end && parts < kMostParts; ++parts) {
    const double to = std::min(end, from + step);
    if (holds(from, to)) {
      from = to;
      step *= 2;
    } else if (step > resolution) {
      step *= 0.5;
    } else {
      break;
    }
  }
  return from;
}

/// The sign of f all over a part of [-1, 1]; 0 where it is not proven.
int sign_on(const PathModel& f, double from, double to);

/// The largest s up to which f is proven to be positive from s = -1 on; -1 if it is nowhere. Exact
/// to `resolution` where f changes sign.
double positive_until(const PathModel& f, double resolution);

/// Returns whether f is proven to be negative at s = 1.
bool is_negative_at_end(const PathModel& f);

}  // namespace misalign::solver
