#include "solver/optimise/body_distance.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cassert>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::RowVectorXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// A point this close to the line between two corners, relative to their distance, lies on it.
constexpr double kOnEdge = 1e-9;

// Weights of the corners whose sum is a point of a polygon: on an edge the two ends, which alone
// move it; otherwise the first three.
VectorXd weights_of(const Vector3d& at, const PolygonCorners& corners) {
  const Index count = corners.cols();
  assert(count >= 2);
  VectorXd weights = VectorXd::Zero(count);
  for (Index k = 0; k < count; ++k) {
    const Index next = (k + 1) % count;
    const Vector3d edge = corners.col(next) - corners.col(k), to = at - corners.col(k);
    const double t = std::clamp(to.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    if ((to - t * edge).norm() > kOnEdge * edge.norm() && count > 2) continue;
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

// Places the outline by its weights.
PlacedBody placed(std::vector<int> vertices, Eigen::MatrixXd weights,
                  const PathGradients::Shape& folded) {
  PlacedBody body{std::move(vertices), std::move(weights), {}};
  Eigen::Matrix3Xd at_mm(3, std::ssize(body.vertices));
  for (std::size_t k = 0; k < body.vertices.size(); ++k) {
    at_mm.col(static_cast<Index>(k)) = folded.at_mm.col(body.vertices[k]);
  }
  body.outline = at_mm * body.weights;
  return body;
}

// Gradient of the displacement, in one direction, of a point that is fixed in the body.
RowVectorXd moves_along(const PlacedBody& body, const Vector3d& direction, const Vector3d& at,
                        const Eigen::MatrixXd& by_mm) {
  const VectorXd weights = body.weights * weights_of(at, body.outline);
  RowVectorXd row = RowVectorXd::Zero(by_mm.cols());
  for (std::size_t k = 0; k < body.vertices.size(); ++k) {
    row += weights(static_cast<Index>(k)) * direction.transpose() *
           by_mm.middleRows<3>(3 * body.vertices[k]);
  }
  return row;
}

}  // namespace

PlacedBody placed_panel(const Sheet& sheet, const PathGradients::Shape& folded, int panel,
                        const PolygonCorners& flat_mm) {
  const auto& corners = sheet.panels().corners[static_cast<std::size_t>(panel)];
  PolygonCorners flat(3, 4);
  for (Index k = 0; k < 4; ++k) {
    const int vertex = corners[static_cast<std::size_t>(k)];
    flat.col(k) << sheet.vertices_mm().col(vertex) - sheet.vertices_mm().col(0), 0;
  }
  Eigen::MatrixXd weights(4, flat_mm.cols());
  for (Index k = 0; k < flat_mm.cols(); ++k) weights.col(k) = weights_of(flat_mm.col(k), flat);
  return placed({corners.begin(), corners.end()}, std::move(weights), folded);
}

PlacedBody placed_line(const PathGradients::Shape& folded, int from, int to, double left_out) {
  assert(left_out >= 0 && left_out < 0.5);
  Eigen::MatrixXd weights(2, 2);
  weights << 1 - left_out, left_out, left_out, 1 - left_out;
  return placed({from, to}, std::move(weights), folded);
}

LengthGradient distance_gradient(const PlacedBody& a, const PlacedBody& b,
                                 const PathGradients::Shape& folded) {
  const Separation between = separation_of(a.outline, b.outline);
  if (between.distance == 0) return {0, RowVectorXd::Zero(folded.by_mm.cols())};
  return {between.distance, moves_along(b, between.direction, between.on_b, folded.by_mm) -
                                moves_along(a, between.direction, between.on_a, folded.by_mm)};
}

}  // namespace misalign::solver
