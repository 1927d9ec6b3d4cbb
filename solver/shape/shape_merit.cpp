#include "solver/shape/shape_merit.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Weights of squares: of a distance of one panel width at every vertex, of the second difference of
// shifts, over two panels on either side, and of the whole flat area's relative change.
constexpr double kMisfit = 10, kBend = 0.015, kArea = 10;
// Price of a violated row, per mm, of a panel one mm wide.
constexpr double kPenalty = 3 * 80;
// Weight by which the pose stays where no distance holds it, beside a distance's.
constexpr double kHeld = 1e-3;
// Squares of second differences over two panels on either side, along rows and columns of the mesh:
// a quadratic form of the vertices.
MatrixXd second_differences(const CreasePattern& sheet) {
  std::map<std::pair<int, int>, int> vertex_at;
  constexpr int kDown[] = {0, 0, 1, 1}, kAcross[] = {0, 1, 1, 0};
  for (std::size_t f = 0; f < sheet.facets.size(); ++f) {
    for (std::size_t k = 0; k < 4; ++k) {
      vertex_at[{sheet.places[f][0] + kDown[k], sheet.places[f][1] + kAcross[k]}] =
          sheet.facets[f][k];
    }
  }
  std::vector<std::array<int, 3>> triples;
  for (const auto& [place, vertex] : vertex_at) {
    for (const auto& [down, across] : {std::pair(2, 0), std::pair(0, 2)}) {
      const auto before = vertex_at.find({place.first - down, place.second - across}),
                 after = vertex_at.find({place.first + down, place.second + across});
      if (before == vertex_at.end() || after == vertex_at.end()) continue;
      triples.push_back({before->second, vertex, after->second});
    }
  }
  MatrixXd weights = MatrixXd::Zero(std::ssize(triples), sheet.vertex_count());
  for (std::size_t k = 0; k < triples.size(); ++k) {
    const auto row = static_cast<Index>(k);
    weights(row, triples[k][0]) = weights(row, triples[k][2]) = 1;
    weights(row, triples[k][1]) = -2;
  }
  return weights.transpose() * weights;
}

double area_mm2(const CreasePattern& sheet, const FlatVertices& vertices_mm) {
  double area = 0;
  for (const auto& facet : sheet.facets) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto a = vertices_mm.col(facet[k]), b = vertices_mm.col(facet[(k + 1) % 4]);
      area += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
  }
  return area;
}

}  // namespace

ShapeMerit::ShapeMerit(const CreasePattern& base, std::vector<int> free, Matrix2Xd start_mm,
                       double shift_weight)
    : base_(base),
      width_mm_(base.panel_width_mm),
      size_mm_(width_mm_ * std::sqrt(static_cast<double>(base.facet_count()))),
      free_(std::move(free)),
      start_mm_(std::move(start_mm)),
      shift_weight_per_mm_(shift_weight / width_mm_),
      area_mm2_(area_mm2(base, base.vertices_mm)),
      unevenness_(second_differences(base)) {
  assert(!free_.empty());
}

double ShapeMerit::misfit_weight() const {
  return kMisfit / (width_mm_ * std::sqrt(static_cast<double>(base_.vertex_count())));
}

double ShapeMerit::value(const ShapeMisfit& misfit, const Matrix2Xd& shifts_mm,
                         const std::vector<ShapeRow>& rows) const {
  const double area = area_mm2(base_, base_.vertices_mm + shifts_mm) / area_mm2_ - 1;
  const double off = misfit_weight() * misfit.mm.norm();
  const double shift = shift_weight_per_mm_, bend = kBend / width_mm_;
  const double regular = shift * shift * (shifts_mm - start_mm_).squaredNorm() +
                         bend * bend * (shifts_mm * unevenness_).cwiseProduct(shifts_mm).sum();
  double below = 0;
  for (const ShapeRow& row : rows) below += std::max(-row.slack, 0.0);
  return (off * off + regular + kArea * kArea * area * area) / 2 + kPenalty / width_mm_ * below;
}

QuadraticProgram ShapeMerit::program(const ShapeMisfit& misfit, const MatrixXd& weights,
                                     const PathGradients::Shape& folded, const Sheet& sheet,
                                     const std::vector<ShapeRow>& rows) const {
  const Index shifts = 2 * std::ssize(free_), count = shifts + 7;
  assert(folded.by_mm.cols() == 2 * base_.vertex_count());
  MatrixXd slopes(misfit.mm.size(), count);
  slopes.leftCols(shifts) = of_free(misfit_by(misfit, weights, folded.by_mm));
  slopes.rightCols(7) = misfit.by_pose;
  slopes.middleCols(shifts, 3) /= size_mm_;
  slopes *= misfit_weight();
  QuadraticProgram program;
  program.hessian = slopes.transpose() * slopes;
  program.gradient = slopes.transpose() * (misfit_weight() * misfit.mm);
  add_regular(sheet, program);
  // A part of the pose that the surface leaves free stays.
  const double held = kHeld * misfit_weight();
  program.hessian.diagonal().tail(7).array() += held * held;
  program.rows.resize(std::ssize(rows), count);
  program.slacks.resize(std::ssize(rows));
  program.rows.rightCols(7).setZero();
  for (Index k = 0; k < std::ssize(rows); ++k) {
    const ShapeRow& row = rows[static_cast<std::size_t>(k)];
    program.rows.row(k).head(shifts) = of_free(row.by_mm);
    program.slacks(k) = row.slack;
  }
  program.penalty = kPenalty / width_mm_;
  return program;
}

void ShapeMerit::add_regular(const Sheet& sheet, QuadraticProgram& program) const {
  const Index shifts = 2 * std::ssize(free_);
  const double by_shift = shift_weight_per_mm_;
  const double off = area_mm2(base_, sheet.vertices_mm()) / area_mm2_ - 1;
  MatrixXd by_area = MatrixXd::Zero(1, 2 * base_.vertex_count());
  for (const auto& facet : base_.facets) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector2d along =
          sheet.point_mm(facet[(k + 1) % 4]) - sheet.point_mm(facet[(k + 3) % 4]);
      by_area(2 * facet[k]) += along.y() / (2 * area_mm2_);
      by_area(2 * facet[k] + 1) -= along.x() / (2 * area_mm2_);
    }
  }
  const VectorXd row = kArea * of_free(by_area).transpose();
  program.hessian.topLeftCorner(shifts, shifts) += row * row.transpose();
  program.hessian.diagonal().head(shifts).array() += by_shift * by_shift;
  program.gradient.head(shifts) += kArea * off * row;
  const double by_bend = kBend / width_mm_;
  const MatrixXd squares = by_bend * by_bend * unevenness_;
  for (Index k = 0; k < shifts; ++k) {
    for (Index i = k % 2; i < shifts; i += 2) {
      program.hessian(k, i) +=
          squares(free_[static_cast<std::size_t>(k / 2)], free_[static_cast<std::size_t>(i / 2)]);
    }
  }
  const MatrixXd bent = (squares * sheet.shifts_mm().transpose()).transpose();
  program.gradient.head(shifts) += of_free(bent.reshaped().transpose()).transpose();
  const MatrixXd moved_mm = (sheet.shifts_mm() - start_mm_).reshaped().transpose();
  program.gradient.head(shifts) += by_shift * by_shift * of_free(moved_mm).transpose();
}

MatrixXd ShapeMerit::of_free(const MatrixXd& by_vertices) const {
  MatrixXd free(by_vertices.rows(), 2 * std::ssize(free_));
  for (Index k = 0; k < std::ssize(free_); ++k) {
    free.middleCols(2 * k, 2) = by_vertices.middleCols(2 * free_[static_cast<std::size_t>(k)], 2);
  }
  return free;
}

}  // namespace misalign::solver
