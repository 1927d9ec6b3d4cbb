#include "solver/certificate/tube_prover.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

#include "solver/certificate/spring_vertex.hpp"

namespace misalign::solver {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kNewtonSteps = 12;
/// A larger first correction comes from another branch.
constexpr double kLongestCorrection = 0.3;
/// A larger correction has the inverse computed again.
constexpr double kFarCorrection = 1e-3;
/// The s, besides the middle, at which J^-1 is evaluated.
constexpr double kInverseAt = 0.85;
constexpr double kSolved = 1e-12, kNearlySolved = 1e-8;
/// An interval whose contraction is larger is shortened, so that checkers can prove it again.
constexpr double kLargestContraction = 0.9;
/// Largest error of the path, with which rates are known and the smallest boxes join.
constexpr double kLargestError = 2e-9;

// Largest factor by which an interval is shortened or lengthened at once.
constexpr double kMuchShorter = 0.3;

// The root of this degree, clamped between kMuchShorter and its inverse.
double limited_root(double power, int degree) {
  double low = kMuchShorter, high = 1 / kMuchShorter;
  for (int step = 0; step < 20; ++step) {
    const double middle = 0.5 * (low + high);
    double product = 1;
    for (int k = 0; k < degree; ++k) product *= middle;
    (product <= power ? low : high) = middle;
  }
  return low;
}

}  // namespace

// Error and contraction grow with a power of the length. Only multiplications decide, so that
// intervals have the same ends on every machine.
double TubeProver::better_length() const {
  constexpr double kTargetError = 1e-10, kTargetContraction = 0.5;
  if (!(error_ < 1)) return kMuchShorter;
  const double by_error = limited_root(kTargetError / error_, kPathDegree + 1);
  if (!(contraction_ < 1e3)) return by_error;
  return std::min(by_error, limited_root(kTargetContraction / contraction_, kInversePowers));
}

TubeProver::TubeProver(const Mechanism& mechanism, const FlatVertices& vertices_mm)
    : mechanism_(mechanism),
      exact_sheet_(place_exactly(mechanism, vertices_mm)),
      path_sheet_(convert<PathModel>(exact_sheet_)),
      jacobian_sheet_(convert<JacobianModel>(exact_sheet_)),
      moving_sheet_(convert<Dual<PathModel>>(path_sheet_)),
      krawczyk_(mechanism) {
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
    use(GradedClosure<T, std::identity>(mechanism_, geometry, chart.joints(), {}, x));
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
  std::vector<double> residual(mechanism_.equations), values;
  with_closure<double>(chart, sheet_, x.data(), s,
                       [&](const auto& closure) { closure.evaluate(residual.data(), &values); });
  return krawczyk_.inverse_of(values);
}

bool TubeProver::solve_middle(IntervalChart& chart) {
  const std::vector<double> zero(mechanism_.unknowns, 0.0);
  double largest = 1;
  for (int step = 0; step < kNewtonSteps && largest > kSolved; ++step) {
    if (largest > kFarCorrection) krawczyk_.set_middle(inverse_at(chart, zero, 0));
    const std::vector<double> residual = residual_of(chart, sheet_, zero, 0.0);
    const Eigen::VectorXd correction =
        krawczyk_.middle() *
        -Eigen::Map<const Eigen::VectorXd>(residual.data(), mechanism_.equations);
    largest = correction.lpNorm<Eigen::Infinity>();
    if (!(largest < kLongestCorrection)) return false;
    chart.recentre(correction.data());
  }
  return largest < kNearlySolved;
}

// The parabola through J^-1 near both ends and in the middle.
void TubeProver::find_inverse(const PathTube& tube) {
  const auto inverse_near = [&](double s) {
    std::vector<double> x(mechanism_.unknowns);
    for (int j = 0; j < mechanism_.unknowns; ++j) x[j] = guess_at(tube.path[j], s);
    return inverse_at(tube.chart, x, s);
  };
  krawczyk_.set_ends(inverse_near(-kInverseAt), inverse_near(kInverseAt), kInverseAt);
}

// Newton's method with one inverse for polynomials gains a power of s with each step.
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
    path.leftCols(Degree + 1) -= krawczyk_.middle() * misfit;
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
  krawczyk_.bound_deviation(values);
}

TubeProver::End TubeProver::prove(const PathInterval& interval, double box, PathTube& tube) {
  assert(box > 0 && box < 1);
  tube.chart = IntervalChart(mechanism_, interval);
  error_ = contraction_ = kInfinite;
  if (!solve_middle(tube.chart)) return End::no_state;
  tube.path = find_path(tube.chart);
  const std::vector<PathModel> residual =
      residual_of(tube.chart, path_sheet_, tube.path, PathModel::line(0, 1));
  Eigen::VectorXd sizes(mechanism_.equations);
  for (int i = 0; i < mechanism_.equations; ++i) sizes[i] = residual[i].bound();
  error_ =
      (krawczyk_.middle().cwiseAbs() * sizes).maxCoeff();  // uses C in the middle only: no proof
  if (!(error_ < kLargestError)) return End::too_curved;

  find_inverse(tube);
  const Eigen::VectorXd misfit = krawczyk_.bound_product(residual);
  find_deviation(tube, box);
  if (!krawczyk_.deviation().allFinite()) return End::not_unique;
  tube.radii = box * krawczyk_.find_weights();
  const Eigen::VectorXd image = krawczyk_.times_deviation(tube.radii);
  tube.contraction = contraction_ = kUp * (image.array() / tube.radii.array()).maxCoeff();
  if (!(contraction_ < kLargestContraction)) return End::not_unique;
  if (!(rounded_up(misfit + image).array() < tube.radii.array()).all()) return End::too_curved;
  const Eigen::VectorXd errors = krawczyk_.bound_solution(tube, misfit);
  for (int j = 0; j < mechanism_.equations; ++j) tube.path[j].radius = errors[j];
  return End::proven;
}

FlatDiagonals TubeProver::flat_diagonals() const {
  const auto ends = [&](const Diagonal& diagonal) {
    return std::pair(spring_vertex(mechanism_, diagonal.loop, diagonal.from_corner),
                     spring_vertex(mechanism_, diagonal.loop, diagonal.to_corner));
  };
  const auto product = [&](const Diagonal& a, const Diagonal& b) {
    const auto [p, q] = ends(a);
    const auto [r, t] = ends(b);
    const auto& [x, y] = std::tie(exact_sheet_.x, exact_sheet_.y);
    return (x[q] - x[p]) * (x[t] - x[r]) + (y[q] - y[p]) * (y[t] - y[r]);
  };
  FlatDiagonals flat;
  for (const Diagonal& diagonal : mechanism_.diagonals) {
    flat.squares.push_back(product(diagonal, diagonal));
  }
  for (std::size_t k = 1; k < mechanism_.diagonals.size(); k += 2) {
    flat.products.push_back(product(mechanism_.diagonals[k - 1], mechanism_.diagonals[k]));
  }
  return flat;
}

DiagonalsAlong TubeProver::find_diagonals(const PathTube& tube) const {
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
  DiagonalsAlong along;
  auto& slopes = along.slopes;
  with_closure<Moving>(tube.chart, moving_sheet_, x.data(), s, [&](const auto& closure) {
    closure.evaluate(residual.data(), nullptr);
    for (const Diagonal& diagonal : mechanism_.diagonals) {
      const Moving g = closure.squared_elongation(diagonal);
      along.stretches.push_back(g.value);
      // The slope is that of sigma g, where graded.
      slopes.push_back(tube.chart.is_graded()
                           ? (PathModel(tube.chart.sigma()) + half_width * s.value) * g.rate +
                                 half_width * g.value
                           : g.rate);
    }
  });
  std::vector<PathModel> misfit(n);
  for (int i = 0; i < n; ++i) misfit[i] = residual[i].rate;
  // All over the tube, w = F_s + J p' gives C w = C J (p' - x'), hence |x' - p'| <= |C w| + |I - C
  // J| |x' - p'|.
  const Eigen::VectorXd errors = krawczyk_.bound_solution(tube, krawczyk_.bound_product(misfit));
  const double scale = tube.chart.is_graded() ? kUp * (tube.chart.sigma() + half_width) : 1;
  for (std::size_t d = 0; d < slopes.size(); ++d) {
    double most = 0;
    for (int j = 0; j < n; ++j) most += rate_bounds_(j, static_cast<Eigen::Index>(d)) * errors[j];
    slopes[d].radius = kUp * (slopes[d].radius + scale * most);
  }
  return along;
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
