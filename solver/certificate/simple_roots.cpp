#include "solver/certificate/simple_roots.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/certificate/conditions.hpp"

namespace misalign::solver {
namespace {

/// Least length of a part.
constexpr double kLeastPart = 1e-9;
/// Places in a part at which it is cut: the first that is certainly no root.
constexpr double kCuts[] = {0.5, 0.4, 0.6, 0.45};

// The sign of the derivative all over a part.
int slope_sign_on(const PathModel& f, double from, double to) {
  PathModel slope = derivative(f);
  const double inside = 1 - std::max(std::abs(from), std::abs(to));
  slope.radius = kUp * (slope.radius + f.radius / inside);  // infinite at the ends
  return sign_on(slope, from, to);
}

// Adds the roots in a part; returns false where they are not proven.
bool add_roots(const PathModel& f, double from, double to, std::vector<RootPart>& roots) {
  assert(from < to);
  if (sign_on(f, from, to) != 0) return true;
  const int before = sign_at(f, from), behind = sign_at(f, to);
  if (before == 0 || behind == 0) return false;
  if (slope_sign_on(f, from, to) != 0) {
    if (before != behind) roots.push_back({from, to, behind});
    return true;
  }
  if (to - from < kLeastPart) return false;
  for (const double share : kCuts) {
    const double cut = from + share * (to - from);
    if (sign_at(f, cut) == 0) continue;
    return add_roots(f, from, cut, roots) && add_roots(f, cut, to, roots);
  }
  return false;
}

}  // namespace

int sign_at(const PathModel& f, const Ball& s) {
  const Ball value = value_at(f, s);
  return std::abs(value.c[0]) > kUp * value.radius ? (value.c[0] > 0 ? 1 : -1) : 0;
}

std::optional<std::vector<RootPart>> isolate_roots(const PathModel& f) {
  std::vector<RootPart> roots;
  if (!add_roots(f, -1, 1, roots)) return std::nullopt;
  return roots;
}

}  // namespace misalign::solver
