// Proves all roots of a function along a proven interval.
//
// Models of a tube hold for complex s, too (README.md, "Wells"): the function is holomorphic for
// |s| < 1, and nowhere there farther from the model's polynomial P than its radius R. By Cauchy's
// estimate its derivative differs from P' by at most R / (1 - |s|) at a real s. Where that has one
// sign there is one root at most.
#pragma once

#include <optional>
#include <vector>

#include "solver/certificate/path_tube.hpp"

namespace misalign::solver {

/// Part of (-1, 1) with exactly one root of a function.
struct RootPart {
  double from, to;
  int sign_behind;  ///< the function's sign at `to`; at `from` it is the opposite
};

/// The sign of f at one s; 0 where it is not proven.
int sign_at(const PathModel& f, const Ball& s);

/// The parts that hold all roots of f, from -1 to 1, which is no root; none where that is not
/// proven.
std::optional<std::vector<RootPart>> isolate_roots(const PathModel& f);

}  // namespace misalign::solver
