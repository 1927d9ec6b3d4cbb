#include "solver/optimise/shape_changes.hpp"

#include <Eigen/QR>
#include <cassert>
#include <optional>

#include "solver/target/shape_measure.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Distances, along x, y and z from places, with their derivatives by the flat vertices.
struct MovingMisfit {
  ShapeMisfit misfit;
  MatrixXd by_mm;

  VectorXd mm() const { return misfit.mm.head(misfit.measured); }
};

std::optional<MovingMisfit> moving_misfit(SheetChanges& changes) {
  assert(changes.options.shape);
  const ShapeMeasure& measure = *changes.options.shape;
  const auto folded = changes.gradients.vertices(measure.at_deg());
  changes.is_known = changes.is_known && folded;
  if (!folded) return {};
  ShapeMisfit misfit = measure.fitted(folded->at_mm);
  const MatrixXd held = misfit_by(misfit, measure.target().weights, folded->by_mm);
  const MatrixXd pose_by_mm = -misfit.by_pose.completeOrthogonalDecomposition().solve(held);
  MatrixXd by_mm = (held + misfit.by_pose * pose_by_mm).topRows(misfit.measured);
  return MovingMisfit{std::move(misfit), std::move(by_mm)};
}

// Scale of the distances beside their root mean square, whose model has no curvature: with it none
// grows beyond the largest over kBeside while the mean falls.
constexpr double kBeside = 0.8;

// The negative of a distance that has this gradient.
GoalTerm distance_term(const SheetChanges& changes, double mm, const Eigen::RowVectorXd& by_mm) {
  return {-mm, 1, changes.variables.row(-by_mm)};
}

// Terms of the largest distance, all scaled.
void add_distances(const SheetChanges& changes, const MovingMisfit& moving, double scale,
                   std::vector<GoalTerm>& terms) {
  const VectorXd mm = scale * moving.mm();
  const MatrixXd by_mm = scale * moving.by_mm;
  if (changes.options.shape->target().surface) {
    for (Index k = 0; k < mm.size(); ++k) {
      terms.push_back(distance_term(changes, mm(k), by_mm.row(k)));
      terms.push_back(distance_term(changes, -mm(k), -by_mm.row(k)));
    }
    return;
  }
  for (Index k = 0; k < mm.size(); k += 3) {
    const double away_mm = mm.segment<3>(k).norm();
    const Eigen::Vector3d along =
        away_mm > 0 ? Eigen::Vector3d(mm.segment<3>(k) / away_mm) : Eigen::Vector3d::Zero();
    terms.push_back(distance_term(changes, away_mm, along.transpose() * by_mm.middleRows<3>(k)));
  }
}

}  // namespace

std::vector<GoalTerm> local_shape_rms(SheetChanges& changes) {
  const auto moving = moving_misfit(changes);
  if (!moving) return {};
  const VectorXd mm = moving->mm();
  const double rms_mm = moving->misfit.rms_mm();
  const auto count = static_cast<double>(moving->misfit.distances_mm().size());
  if (rms_mm == 0) return {distance_term(changes, 0, 0 * moving->by_mm.row(0))};
  std::vector<GoalTerm> terms{
      distance_term(changes, rms_mm, mm.transpose() * moving->by_mm / (count * rms_mm))};
  add_distances(changes, *moving, kBeside * rms_mm / moving->misfit.max_mm(), terms);
  return terms;
}

std::vector<GoalTerm> local_shape_max(SheetChanges& changes) {
  const auto moving = moving_misfit(changes);
  if (!moving) return {};
  std::vector<GoalTerm> terms;
  add_distances(changes, *moving, 1, terms);
  return terms;
}

}  // namespace misalign::solver
