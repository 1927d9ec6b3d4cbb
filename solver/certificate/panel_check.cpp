#include "solver/certificate/panel_check.hpp"

#include <cassert>

namespace misalign::solver {
namespace {

using Corners = std::array<std::array<CheckModel, 3>, 4>;

PanelCorners corners_at(const Corners& corners, double s) {
  PanelCorners middle;
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 3; ++i) {
      middle(i, k) = as_double(value_at(corners[k][i], ArbNumber(s)));
    }
  }
  return middle;
}

// Coordinates of a panel's corners along a direction, from one of them or from the origin.
std::array<CheckModel, 4> heights(const Eigen::Vector3d& direction, const Corners& corners,
                                  std::optional<int> from) {
  std::array<CheckModel, 4> along;
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 3; ++i) along[k].add_product(ArbNumber(direction[i]), corners[k][i]);
  }
  if (!from) return along;
  const CheckModel origin = along[*from];
  for (CheckModel& height : along) height = height - origin;
  return along;
}

bool are_apart_along(const ComparedPanels& panels, const Eigen::Vector3d& direction,
                     const Corners& a, const Corners& b, double middle, double half) {
  const auto is_above = [&](const CheckModel& f) {
    return is_positive(f, middle, half) == Proof::holds;
  };
  if (panels.kind == ContactKind::apart) {
    const auto of_a = heights(direction, a, {}), of_b = heights(direction, b, {});
    for (const CheckModel& low : of_a) {
      for (const CheckModel& high : of_b) {
        if (!is_above(high - low)) return false;
      }
    }
    return true;
  }
  const auto of_a = heights(direction, a, panels.vertex_of_a);
  const auto of_b = heights(direction, b, panels.vertex_of_b);
  for (int side = 1; side < 4; ++side) {
    if (!is_above(-of_a[(panels.vertex_of_a + side) % 4])) return false;
    if (!is_above(of_b[(panels.vertex_of_b + side) % 4])) return false;
  }
  return true;
}

// Compares panels on a part of the subinterval; where one direction does not suffice, each half
// gets its own. `parts` limits their number: panels that almost touch for long would need very
// many.
bool are_panels_apart(const ComparedPanels& panels, const Corners& a, const Corners& b,
                      double middle, double half, int& parts) {
  constexpr double kShortest = 0x1p-26;
  assert(half > 0 && middle - half >= -1 && middle + half <= 1);
  constexpr int kMostParts = 10000;
  if (++parts > kMostParts) return false;
  const auto direction = separating_direction(panels, corners_at(a, middle), corners_at(b, middle));
  if (direction && are_apart_along(panels, *direction, a, b, middle, half)) return true;
  if (!direction || half < kShortest) return false;
  return are_panels_apart(panels, a, b, middle - half / 2, half / 2, parts) &&
         are_panels_apart(panels, a, b, middle + half / 2, half / 2, parts);
}

}  // namespace

PanelCheck::PanelCheck(const FoldedShape& shape, const Panels& panels)
    : shape_(shape),
      panels_(panels),
      compared_(compared_panels(panels)),
      pairs_(static_cast<int>(pairs_of(panels).size())) {}

Proof PanelCheck::are_apart(const IntervalProver& prover, const ProvenInterval& interval,
                            const ProvenInterval::Subinterval& subinterval) const {
  const auto corners = prover.place_panels(interval, subinterval, shape_, panels_);
  assert(corners.size() == panels_.facets.size());
  for (const ComparedPanels& panels : compared_) {
    int parts = 0;
    if (!are_panels_apart(panels, corners[panels.a], corners[panels.b], 0, 1, parts)) {
      return Proof::unclear;
    }
  }
  return Proof::holds;
}

}  // namespace misalign::solver
