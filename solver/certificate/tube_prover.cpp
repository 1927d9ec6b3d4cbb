#include "solver/certificate/tube_prover.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "solver/certificate/interval_length.hpp"

namespace misalign::solver {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kNewtonSteps = 12;
/// A first correction that is larger has come from elsewhere.
constexpr double kLongestCorrection = 0.3;
/// Beyond it the inverse is made anew.
constexpr double kFarCorrection = 1e-3;
/// Where in an interval J^-1 is taken, beside its middle.
constexpr double kInverseAt = 0.85;
constexpr double kSolved = 1e-12, kNearlySolved = 1e-8;
/// The least of r over its largest: no unknown's box is of no use.
constexpr double kLeastWeight = 0.05;
/// An interval whose contraction is larger is made shorter, so that others can prove it again.
constexpr double kLargestContraction = 0.9;
/// So well is the path to be known that rates of change are, and that it joins the smallest boxes.
constexpr double kLargestError = 2e-9;

// Sums of nonnegative numbers, in a fixed order: a bound from above.
Eigen::VectorXd rounded_up(const Eigen::VectorXd& sums) { return kUp * sums.array() + kUnderflow; }

// A vector that |I - C J| makes smaller, its largest entry 1: its eigenvector, but for small
// entries.
Eigen::VectorXd find_weights(const Eigen::MatrixXd& deviation) {
  assert(deviation.rows() == deviation.cols() && deviation.allFinite());
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(deviation.rows());
  for (int k = 0; k < 8; ++k) {
    const Eigen::VectorXd image = deviation * weights;
    weights = (image / image.maxCoeff()).cwiseMax(kLeastWeight);
  }
  return weights;
}

// The derivative of a polynomial, by s.
PathModel derivative(const PathModel& p) {
  PathModel rate;
  for (int k = 1; k <= kPathDegree; ++k) rate.c[k - 1] = k * p.c[k];
  rate.radius = kUp * kUnit * rate.size();
  return rate;
}

}  // namespace

double TubeProver::better_length() const {
  return misalign::solver::better_length(error_, kPathDegree + 1, contraction_, kInversePowers);
}

TubeProver::TubeProver(const Mechanism& mechanism, const FlatVertices& vertices_mm)
    : mechanism_(mechanism),
      columns_(columns_of(mechanism)),
      path_sheet_(with_errors<PathModel>(place_exactly(mechanism, vertices_mm))),
      jacobian_sheet_(with_errors<JacobianModel>(place_exactly(mechanism, vertices_mm))),
      moving_sheet_(
          convert<Dual<PathModel>>(with_errors<PathModel>(place_exactly(mechanism, vertices_mm)))) {
  assert(kInversePowers * mechanism.equations + 100 < kMostOperations);
  place(mechanism, vertices_mm, sheet_);
  half_sheet_ = convert<Polynomial<kHalfDegree>>(sheet_);
  whole_sheet_ = convert<Polynomial<kPathDegree>>(sheet_);
}

template <class T, class Use>
void TubeProver::with_closure(const IntervalChart& chart, const SheetGeometry<T>& geometry,
                              const T* x, const T& s, Use&& use) const {
  if (chart.is_graded()) {
    const GradedBy<T> sigma{T(chart.sigma()) + chart.half_width() * s};
    use(GradedClosure<T, GradedBy<T>>(mechanism_, geometry, chart.joints(), sigma, x));
  } else {
    use(GradedClosure<T, Ungraded>(mechanism_, geometry, chart.joints(), Ungraded{}, x));
  }
}

template <class T>
std::vector<T> TubeProver::residual_of(const IntervalChart& chart, const SheetGeometry<T>& geometry,
                                       const std::vector<T>& x, const T& s) const {
  std::vector<T> residual(mechanism_.equations);
  with_closure<T>(chart, geometry, x.data(), s,
                  [&](const auto& closure) { closure.evaluate(residual.data(), nullptr); });
  return residual;
}

// J^-1 at these unknowns and s.
Eigen::MatrixXd TubeProver::inverse_at(const IntervalChart& chart, const std::vector<double>& x,
                                       double s) const {
  const int n = mechanism_.equations;
  std::vector<double> residual(n), values;
  assert(std::ssize(x) == mechanism_.unknowns);
  with_closure<double>(chart, sheet_, x.data(), s,
                       [&](const auto& closure) { closure.evaluate(residual.data(), &values); });
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(n, n);
  for (int j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < columns_[j].rows.size(); ++k) {
      jacobian(columns_[j].rows[k], j) = values[columns_[j].values[k]];
    }
  }
  return jacobian.partialPivLu().inverse();
}

bool TubeProver::solve_middle(IntervalChart& chart) {
  const std::vector<double> zero(mechanism_.unknowns, 0.0);
  double largest = 1;
  for (int step = 0; step < kNewtonSteps && largest > kSolved; ++step) {
    if (largest > kFarCorrection) inverse_[0] = inverse_at(chart, zero, 0);
    const std::vector<double> residual = residual_of(chart, sheet_, zero, 0.0);
    const Eigen::VectorXd correction =
        inverse_[0] * -Eigen::Map<const Eigen::VectorXd>(residual.data(), mechanism_.equations);
    largest = correction.lpNorm<Eigen::Infinity>();
    if (!(largest < kLongestCorrection)) return false;
    chart.recentre(correction.data());
  }
  return largest < kNearlySolved;
}

// The parabola through J^-1 near both ends and in the middle.
void TubeProver::find_inverse(const PathTube& tube) {
  std::array<Eigen::MatrixXd, 2> at_ends;
  std::vector<double> x(mechanism_.unknowns);
  for (int end = 0; end < 2; ++end) {
    const double s = end == 0 ? -kInverseAt : kInverseAt;
    for (int j = 0; j < mechanism_.unknowns; ++j) {
      x[j] = 0;
      for (int k = kPathDegree; k >= 0; --k) x[j] = x[j] * s + tube.path[j].c[k];
    }
    at_ends[end] = inverse_at(tube.chart, x, s);
  }
  inverse_[1] = (at_ends[1] - at_ends[0]) / (2 * kInverseAt);
  inverse_[2] = (at_ends[1] + at_ends[0] - 2 * inverse_[0]) / (2 * kInverseAt * kInverseAt);
  absolute_inverse_ = inverse_[0].cwiseAbs() + inverse_[1].cwiseAbs() + inverse_[2].cwiseAbs();
}

// Newton's method with one inverse for polynomials: a power of s more with each step.
template <int Degree>
void TubeProver::add_powers(const IntervalChart& chart,
                            const SheetGeometry<Polynomial<Degree>>& sheet, int steps,
                            Eigen::MatrixXd& path) const {
  const int n = mechanism_.equations;
  std::vector<Polynomial<Degree>> x(mechanism_.unknowns);
  if (!chart.is_graded()) x[n] = Polynomial<Degree>::line(0, chart.half_width());
  Eigen::MatrixXd misfit(n, Degree + 1);
  for (int step = 0; step < steps; ++step) {
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k <= Degree; ++k) x[i].c[k] = path(i, k);
    }
    const auto residual = residual_of(chart, sheet, x, Polynomial<Degree>::line(0, 1));
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k <= Degree; ++k) misfit(i, k) = residual[i].c[k];
    }
    path.leftCols(Degree + 1) -= inverse_[0] * misfit;
  }
}

std::vector<PathModel> TubeProver::find_path(const IntervalChart& chart) const {
  const int n = mechanism_.equations;
  Eigen::MatrixXd powers = Eigen::MatrixXd::Zero(n, kPathDegree + 1);
  add_powers<kHalfDegree>(chart, half_sheet_, kHalfDegree, powers);
  add_powers<kPathDegree>(chart, whole_sheet_, kPathDegree - kHalfDegree + 1, powers);
  std::vector<PathModel> path(mechanism_.unknowns);
  if (!chart.is_graded()) path[n] = PathModel::line(0, chart.half_width());
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k <= kPathDegree; ++k) path[i].c[k] = powers(i, k);
  }
  return path;
}

template <int Degree>
Eigen::VectorXd TubeProver::bound_product(const std::vector<TaylorModel<Degree>>& residual) const {
  const int n = mechanism_.equations;
  Eigen::VectorXd most = Eigen::VectorXd::Zero(n);
  assert(std::ssize(residual) == n);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, Degree + kInversePowers);
  for (int j = 0; j < n; ++j) {
    for (int power = 0; power < kInversePowers; ++power) {
      for (int k = 0; k <= Degree; ++k) {
        sums.col(power + k) += residual[j].c[k] * inverse_[power].col(j);
      }
    }
    most += (residual[j].radius + (kInversePowers * n + 2) * kUnit * residual[j].size()) *
            absolute_inverse_.col(j);
  }
  for (int k = 0; k < Degree + kInversePowers; ++k) most += sums.col(k).cwiseAbs();
  return rounded_up(most);
}

// Every unknown, the path's polynomials widened by their errors and by `box`.
std::vector<JacobianModel> TubeProver::unknowns(const PathTube& tube, double box) const {
  std::vector<JacobianModel> x(mechanism_.unknowns,
                               JacobianModel::line(0, tube.chart.half_width()));
  for (int j = 0; j < mechanism_.equations; ++j) {
    x[j] = lower<kJacobianDegree>(tube.path[j]);
    x[j].radius = kUp * (x[j].radius + box);
  }
  return x;
}

void TubeProver::find_deviation(const PathTube& tube, double box) {
  const int n = mechanism_.equations;
  const std::vector<JacobianModel> x = unknowns(tube, box);
  std::vector<JacobianModel> residual(n), values;
  rate_bounds_ = Eigen::MatrixXd::Zero(n + 1, mechanism_.diagonal_count());
  with_closure<JacobianModel>(
      tube.chart, jacobian_sheet_, x.data(), JacobianModel::line(0, 1), [&](const auto& closure) {
        closure.evaluate(residual.data(), &values);
        for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
          closure.squared_elongation_rates(mechanism_.diagonals[d],
                                           [&](int column, const JacobianModel& rate) {
                                             rate_bounds_(column, d) = rate.bound();
                                           });
        }
      });
  deviation_.resize(n, n);
  Eigen::MatrixXd sums(n, kJacobianDegree + kInversePowers);
  for (int j = 0; j < n; ++j) {
    sums.setZero();
    Eigen::VectorXd most = Eigen::VectorXd::Zero(n);
    const std::size_t entries = columns_[j].rows.size();
    for (std::size_t e = 0; e < entries; ++e) {
      const JacobianModel& value = values[columns_[j].values[e]];
      const int row = columns_[j].rows[e];
      for (int power = 0; power < kInversePowers; ++power) {
        for (int k = 0; k <= kJacobianDegree; ++k) {
          sums.col(power + k) += value.c[k] * inverse_[power].col(row);
        }
      }
      const double operations = static_cast<double>(kInversePowers * entries + 2);
      most += (value.radius + operations * kUnit * value.size()) * absolute_inverse_.col(row);
    }
    sums(j, 0) -= 1;
    most[j] += 2 * kUnit;  // by which that may be off: it is below 2
    if (!(std::abs(sums(j, 0)) < 1)) most[j] = kInfinite;
    for (int k = 0; k < sums.cols(); ++k) most += sums.col(k).cwiseAbs();
    deviation_.col(j) = rounded_up(most);
  }
}

Eigen::VectorXd TubeProver::times_deviation(const Eigen::VectorXd& radii) const {
  assert(radii.size() == deviation_.cols());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(radii.size());
  for (Eigen::Index j = 0; j < radii.size(); ++j) sum += radii[j] * deviation_.col(j);
  return rounded_up(sum);
}

TubeProver::End TubeProver::prove(const PathInterval& interval, double box, PathTube& tube) {
  assert(box > 0 && box < 1);
  tube.chart = IntervalChart(mechanism_, interval);
  error_ = contraction_ = kInfinite;
  if (!solve_middle(tube.chart)) return End::no_state;
  tube.path = find_path(tube.chart);
  const std::vector<PathModel> residual =
      residual_of(tube.chart, path_sheet_, tube.path, PathModel::line(0, 1));
  error_ = estimate_error(residual);
  if (!(error_ < kLargestError)) return End::too_curved;

  find_inverse(tube);
  const Eigen::VectorXd misfit = bound_product(residual);
  find_deviation(tube, box);
  if (!deviation_.allFinite()) return End::not_unique;
  tube.radii = box * find_weights(deviation_);
  const Eigen::VectorXd image = times_deviation(tube.radii);
  tube.contraction = contraction_ = kUp * (image.array() / tube.radii.array()).maxCoeff();
  if (!(contraction_ < kLargestContraction)) return End::not_unique;
  if (!(rounded_up(misfit + image).array() < tube.radii.array()).all()) return End::too_curved;
  const Eigen::VectorXd errors = bound_solution(tube, misfit);
  for (int j = 0; j < mechanism_.equations; ++j) tube.path[j].radius = errors[j];
  return End::proven;
}

// How far p is from the path, by C in the middle: no proof.
double TubeProver::estimate_error(const std::vector<PathModel>& residual) const {
  Eigen::VectorXd sizes(mechanism_.equations);
  for (int i = 0; i < mechanism_.equations; ++i) sizes[i] = residual[i].bound();
  return (inverse_[0].cwiseAbs() * sizes).maxCoeff();
}

// At least |e| for every e with |e| <= most + |I - C J| |e|: in the norm of r it is at most that of
// `most` / (1 - contraction), and within what the inequality makes of a bound.
Eigen::VectorXd TubeProver::bound_solution(const PathTube& tube,
                                           const Eigen::VectorXd& most) const {
  if (!most.allFinite()) return Eigen::VectorXd::Constant(most.size(), kInfinite);
  assert(tube.contraction < 1 && "else nothing is bounded");
  assert(most.size() == tube.radii.size() && tube.radii.minCoeff() > 0);
  const double largest = (most.array() / tube.radii.array()).maxCoeff();
  Eigen::VectorXd errors = rounded_up(kUp * (largest / (1 - tube.contraction)) * tube.radii);
  for (int k = 0; k < 2; ++k) errors = errors.cwiseMin(rounded_up(most + times_deviation(errors)));
  return errors;
}

std::vector<PathModel> TubeProver::find_slopes(const PathTube& tube) const {
  assert(std::ssize(tube.path) == mechanism_.unknowns);
  using Moving = Dual<PathModel>;
  const int n = mechanism_.equations;
  const double half_width = tube.chart.half_width();
  std::vector<Moving> x(mechanism_.unknowns);
  for (int j = 0; j < n; ++j) {
    x[j] = Moving(tube.path[j], derivative(tube.path[j]));
  }
  if (!tube.chart.is_graded()) x[n] = Moving(PathModel::line(0, half_width), half_width);
  const Moving s(PathModel::line(0, 1), 1.0);
  std::vector<Moving> residual(n);
  std::vector<PathModel> slopes;
  with_closure<Moving>(tube.chart, moving_sheet_, x.data(), s, [&](const auto& closure) {
    closure.evaluate(residual.data(), nullptr);
    for (const Diagonal& diagonal : mechanism_.diagonals) {
      const Moving g = closure.squared_elongation(diagonal);
      // Of sigma g, where graded.
      slopes.push_back(tube.chart.is_graded()
                           ? (PathModel(tube.chart.sigma()) + half_width * s.value) * g.rate +
                                 half_width * g.value
                           : g.rate);
    }
  });
  std::vector<PathModel> misfit(n);
  for (int i = 0; i < n; ++i) misfit[i] = residual[i].rate;
  // With w = F_s + J p' all over the tube, C w = C J (p' - x'), hence |x' - p'| <= |C w| + |I - C
  // J| |x' - p'|.
  const Eigen::VectorXd errors = bound_solution(tube, bound_product(misfit));
  const double scale = tube.chart.is_graded() ? kUp * (tube.chart.sigma() + half_width) : 1;
  for (std::size_t d = 0; d < slopes.size(); ++d) {
    double most = 0;
    for (int j = 0; j < n; ++j) most += rate_bounds_(j, static_cast<Eigen::Index>(d)) * errors[j];
    slopes[d].radius = kUp * (slopes[d].radius + scale * most);
  }
  return slopes;
}

std::vector<std::array<GradedVector<JacobianModel>, 4>> TubeProver::place_panels(
    const PathTube& tube, const FoldedShape& shape, const Panels& panels) const {
  const std::vector<JacobianModel> x = unknowns(tube, 0);
  std::vector<std::array<GradedVector<JacobianModel>, 4>> corners;
  with_closure<JacobianModel>(
      tube.chart, jacobian_sheet_, x.data(), JacobianModel::line(0, 1), [&](const auto& closure) {
        corners = closure.place_panels(shape.tree(), panels.facets, panels.corners);
      });
  return corners;
}

}  // namespace misalign::solver
