#include "solver/optimise/coordinates.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {

using Eigen::Index;
using Eigen::VectorXd;

Coordinates::Coordinates(const OptimiseOptions& options)
    : options_(options),
      shifts_(are_free() ? options.moves.cols() : 2 * std::ssize(options.shifted)) {}

const OptimiseOptions::Range* Coordinates::range(Index k) const {
  assert(k >= 0 && k < count());
  if (k < shifts_) return nullptr;
  return k == shifts_ && options_.stiffness_n_per_mm ? &*options_.stiffness_n_per_mm
                                                     : &*options_.preload_n;
}

VectorXd Coordinates::of(const DesignPoint& point) const {
  VectorXd values_mm = VectorXd::Zero(count());
  for (Index k = 0; k < shifts_ && !are_free(); ++k) {
    values_mm(k) = point.shifts_mm(k % 2, options_.shifted[static_cast<std::size_t>(k / 2)]);
  }
  Index next = shifts_;
  const auto add = [&](const std::optional<OptimiseOptions::Range>& range, double value) {
    if (range) values_mm(next++) = (value - range->least) / per_mm(*range) - options_.amplitude_mm;
  };
  add(options_.stiffness_n_per_mm, point.stiffness_n_per_mm);
  add(options_.preload_n, point.preload_n);
  assert(next == count());
  return values_mm;
}

DesignPoint Coordinates::after(const DesignPoint& point, const VectorXd& change_mm) const {
  DesignPoint next = point;
  assert(change_mm.size() == count());
  const VectorXd moved_mm = are_free() ? VectorXd(options_.moves * change_mm.head(shifts_))
                                       : VectorXd(change_mm.head(shifts_));
  const double most_mm = largest_mm(0);
  for (Index k = 0; k < moved_mm.size(); ++k) {
    double& shift_mm = next.shifts_mm(k % 2, options_.shifted[static_cast<std::size_t>(k / 2)]);
    shift_mm = on_grid(shift_mm + moved_mm(k), options_.grid_mm);
    if (!are_free()) shift_mm = std::clamp(shift_mm, -most_mm, most_mm);
  }
  const double farthest_mm = next.shifts_mm.cwiseAbs().maxCoeff();
  if (are_free() && farthest_mm > most_mm) next.shifts_mm *= most_mm / farthest_mm;
  Index at = shifts_;
  const auto change = [&](const std::optional<OptimiseOptions::Range>& range, double& value) {
    if (!range) return;
    value = std::clamp(value + change_mm(at++) * per_mm(*range), range->least, range->most);
  };
  change(options_.stiffness_n_per_mm, next.stiffness_n_per_mm);
  change(options_.preload_n, next.preload_n);
  return next;
}

double Coordinates::largest_mm(Index k) const {
  const double grid_mm = options_.grid_mm;
  if (grid_mm == 0 || range(k)) return options_.amplitude_mm;
  return std::floor(options_.amplitude_mm / grid_mm * (1 + 1e-12)) * grid_mm;
}

VectorXd Coordinates::row(const Eigen::RowVectorXd& by_vertices, double by_stiffness,
                          double by_preload) const {
  VectorXd of_shifted(2 * std::ssize(options_.shifted));
  assert(by_vertices.size() % 2 == 0);
  Index k = 0;
  for (const int vertex : options_.shifted) {
    of_shifted(k++) = by_vertices(2 * vertex);
    of_shifted(k++) = by_vertices(2 * vertex + 1);
  }
  VectorXd row = VectorXd::Zero(count());
  row.head(shifts_) = are_free() ? VectorXd(options_.moves.transpose() * of_shifted) : of_shifted;
  Index next = shifts_;
  if (options_.stiffness_n_per_mm) {
    row(next++) = by_stiffness * per_mm(*options_.stiffness_n_per_mm);
  }
  if (options_.preload_n) row(next++) = by_preload * per_mm(*options_.preload_n);
  return row;
}

DesignPoint point_of(const Eigen::Matrix2Xd& shifts_mm, const OptimiseOptions& options) {
  const Springs& springs = options.deploying.sheet.springs();
  return {shifts_mm, springs.stiffness_n_per_mm, springs.preload.each_n};
}

void set_springs(OptimiseOptions& options, const DesignPoint& point) {
  Springs& springs = options.deploying.sheet.springs();
  springs.stiffness_n_per_mm = point.stiffness_n_per_mm;
  springs.preload.each_n = point.preload_n;
}

double on_grid(double mm, double grid_mm) {
  assert(grid_mm >= 0);
  return grid_mm > 0 ? std::round(mm / grid_mm) * grid_mm : mm;
}

}  // namespace misalign::solver
