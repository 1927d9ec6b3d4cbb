#include "solver/optimise/thickness_changes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/contact/contact.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

// Number of angles at which pairs are compared; those within the factor kClose of the least
// distance count, and so do tapers.
constexpr int kAngles = 12;
constexpr double kClose = 1.3;
// Tapers are differenced over two sheets beside one: they are halved down to rounding.
constexpr double kNextTaper_mm = 1e-4;

// Gradient of the tapers, by differences: fold angles at the end follow the vertices.
RowVectorXd taper_by_mm(const Sheet& sheet, const PathGradients::AtAngle& end,
                        const PlateThickness& now, double trim_mm) {
  const FlatVertices& from_a1_mm = sheet.way()->from_a1_mm();
  const Eigen::VectorXd side = end.fold_deg.cwiseSign();
  RowVectorXd by_mm(2 * from_a1_mm.cols());
  assert(std::ssize(now.largest_rad) == side.size() && end.fold_by_mm.cols() == by_mm.size());
  const auto limit_mm = [&](Index k, double change_mm) {
    FlatVertices vertices_mm = from_a1_mm;
    vertices_mm(k % 2, k / 2) += change_mm;
    std::vector<double> largest_rad = now.largest_rad;
    for (Index c = 0; c < side.size(); ++c) {
      largest_rad[static_cast<std::size_t>(c)] +=
          change_mm * kRadPerDeg * side(c) * end.fold_by_mm(c, k);
    }
    return taper_limit(sheet.panels(), trimmed_panels(sheet.panels(), vertices_mm, trim_mm),
                       vertices_mm, largest_rad)
        .thickness_mm;
  };
  for (Index k = 0; k < by_mm.size(); ++k) {
    by_mm(k) = (limit_mm(k, kNextTaper_mm) - limit_mm(k, -kNextTaper_mm)) / (2 * kNextTaper_mm);
  }
  return by_mm;
}

}  // namespace

std::vector<LengthGradient> thickness_changes(const Sheet& sheet, PathGradients& gradients,
                                              std::optional<double> from_deg) {
  const auto study = contact(sheet, {{}, from_deg});
  if (!study || !study->thickness || study->thickness->thickness_mm <= 0) return {};
  const PlateThickness& now = *study->thickness;
  const auto trimmed = trimmed_panels(sheet.panels(), sheet.way()->from_a1_mm(), study->trim_mm);
  std::vector<double> angles_deg{now.pilot_deg};
  for (int k = 1; k <= kAngles; ++k) angles_deg.push_back(study->reach_deg * k / kAngles);
  std::vector<LengthGradient> changes;
  const double part = now.clear_mm > 0 ? 1 - kThicknessSlack : 0;
  for (const double angle_deg : angles_deg) {
    const auto folded = gradients.vertices(angle_deg);
    if (!folded) return {};
    for (const PanelPair& pair : pairs_of(sheet.panels())) {
      if (pair.kind == ContactKind::crease) continue;
      const auto placed = [&](int panel) {
        return placed_panel(sheet, *folded, panel, trimmed[static_cast<std::size_t>(panel)]);
      };
      const LengthGradient distance = distance_gradient(placed(pair.a), placed(pair.b), *folded);
      if (part * distance.mm > kClose * now.thickness_mm) continue;
      changes.push_back({part * distance.mm, part * distance.by_mm});
    }
  }
  if (now.taper_mm <= kClose * now.thickness_mm) {
    const auto end = gradients.at(study->reach_deg);
    if (!end) return {};
    changes.push_back({now.taper_mm, taper_by_mm(sheet, *end, now, study->trim_mm)});
  }
  return changes;
}

}  // namespace misalign::solver
