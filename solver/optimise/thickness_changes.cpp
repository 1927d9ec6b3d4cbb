#include "solver/optimise/thickness_changes.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/contact/contact.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::RowVectorXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Number of angles at which pairs are compared; those within the factor kClose of the least
// distance count, and so do tapers.
constexpr int kAngles = 12;
constexpr double kClose = 1.3;
// Tapers are differenced over two sheets beside one: they are halved down to rounding.
constexpr double kNextTaper_mm = 1e-4;

// A point this close to the line between two corners, relative to their distance, lies on it.
constexpr double kOnEdge = 1e-9;

// Weights of the corners whose sum is a point of a polygon: on an edge the two ends, which alone
// move it; otherwise the first three.
VectorXd weights_of(const Vector3d& at, const PolygonCorners& corners) {
  const Index count = corners.cols();
  assert(count >= 3);
  VectorXd weights = VectorXd::Zero(count);
  for (Index k = 0; k < count; ++k) {
    const Index next = (k + 1) % count;
    const Vector3d edge = corners.col(next) - corners.col(k), to = at - corners.col(k);
    const double t = std::clamp(to.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    if ((to - t * edge).norm() > kOnEdge * edge.norm()) continue;
    weights(k) = 1 - t;
    weights(next) = t;
    return weights;
  }
  Eigen::Matrix<double, 3, 2> sides;
  sides << corners.col(1) - corners.col(0), corners.col(2) - corners.col(0);
  weights.segment<2>(1) = sides.colPivHouseholderQr().solve(at - corners.col(0));
  weights(0) = 1 - weights(1) - weights(2);
  return weights;
}

struct PlacedPanel {
  PlacedPanel(const std::array<int, 4>& corner_vertices, const FlatVertices& vertices_mm,
              const Eigen::Matrix3Xd& folded_mm, const PolygonCorners& flat_mm)
      : corners(corner_vertices), of_corners(4, flat_mm.cols()) {
    assert(folded_mm.cols() == vertices_mm.cols());
    PolygonCorners flat(3, 4), folded(3, 4);
    for (int k = 0; k < 4; ++k) {
      const int vertex = corners[static_cast<std::size_t>(k)];
      flat.col(k) << vertices_mm.col(vertex) - vertices_mm.col(0), 0;
      folded.col(k) = folded_mm.col(vertex);
    }
    for (Index k = 0; k < flat_mm.cols(); ++k) of_corners.col(k) = weights_of(flat_mm.col(k), flat);
    outline = folded * of_corners;
  }

  // Gradient of the displacement, in one direction, of a point that is fixed in the panel.
  RowVectorXd moves_along(const Vector3d& direction, const Vector3d& at,
                          const Eigen::MatrixXd& by_mm) const {
    const Eigen::Vector4d weights = of_corners * weights_of(at, outline);
    RowVectorXd row = RowVectorXd::Zero(by_mm.cols());
    for (int k = 0; k < 4; ++k) {
      row += weights(k) * direction.transpose() *
             by_mm.middleRows<3>(3 * corners[static_cast<std::size_t>(k)]);
    }
    return row;
  }

  const std::array<int, 4> corners;
  Eigen::Matrix4Xd of_corners;  // weights of the outline's points
  PolygonCorners outline;
};

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

LengthGradient distance_gradient(const Sheet& sheet, const PathGradients::Shape& folded,
                                 int panel_a, int panel_b, const PolygonCorners& flat_a_mm,
                                 const PolygonCorners& flat_b_mm) {
  const auto placed = [&](int panel, const PolygonCorners& flat_mm) {
    return PlacedPanel(sheet.panels().corners[static_cast<std::size_t>(panel)], sheet.vertices_mm(),
                       folded.at_mm, flat_mm);
  };
  const PlacedPanel a = placed(panel_a, flat_a_mm), b = placed(panel_b, flat_b_mm);
  const Separation between = separation_of(a.outline, b.outline);
  if (between.distance == 0) return {0, RowVectorXd::Zero(folded.by_mm.cols())};
  return {between.distance, b.moves_along(between.direction, between.on_b, folded.by_mm) -
                                a.moves_along(between.direction, between.on_a, folded.by_mm)};
}

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
      const LengthGradient distance = distance_gradient(sheet, *folded, pair.a, pair.b,
                                                        trimmed[static_cast<std::size_t>(pair.a)],
                                                        trimmed[static_cast<std::size_t>(pair.b)]);
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
