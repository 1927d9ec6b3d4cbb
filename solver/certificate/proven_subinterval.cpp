#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "solver/certificate/proven_interval.hpp"

namespace misalign::solver {
namespace {

using Subinterval = ProvenInterval::Subinterval;

// A value and its derivative with respect to s.
template <class T>
struct WithRate {
  T value, rate;

  WithRate() = default;
  WithRate(double constant) : value(constant) {}  // NOLINT: a number is a constant
  WithRate(T at, T changes) : value(std::move(at)), rate(std::move(changes)) {}

  WithRate operator-() const { return {-value, -rate}; }
  friend WithRate operator+(const WithRate& a, const WithRate& b) {
    return {a.value + b.value, a.rate + b.rate};
  }
  friend WithRate operator-(const WithRate& a, const WithRate& b) {
    return {a.value - b.value, a.rate - b.rate};
  }
  friend WithRate operator*(const WithRate& a, const WithRate& b) {
    return {a.value * b.value, a.value * b.rate + a.rate * b.value};
  }
  friend WithRate scaled(const ArbNumber& k, const WithRate& a) {
    return {scaled(k, a.value), scaled(k, a.rate)};
  }
};

template <class T>
WithRate<T> reciprocal(const WithRate<T>& f) {
  const T inverse = reciprocal(f.value);
  return {inverse, -(f.rate * (inverse * inverse))};
}

// A linear function of s, on a subinterval.
template <int Degree>
void set_line(double at_zero, double width, const Subinterval& subinterval,
              ArbModel<Degree>& line) {
  const ArbNumber middle = ArbNumber(at_zero) + ArbNumber(width) * ArbNumber(subinterval.middle);
  const ArbNumber slope = ArbNumber(width) * ArbNumber(subinterval.half);
  arb_set(line[0], middle[0]);
  arb_set(line[1], slope[0]);
}
template <int Degree>
void set_line(double at_zero, double width, const Subinterval& subinterval,
              Polynomial<Degree>& line) {
  line.c[0] = at_zero + width * subinterval.middle;
  line.c[1] = width * subinterval.half;
}
void set_line(double at_zero, double width, const Subinterval& subinterval, double& line) {
  line = at_zero + width * subinterval.middle;
}
template <int Degree>
void set_line(double at_zero, double width, const Subinterval& subinterval,
              WithRate<ArbModel<Degree>>& line) {
  set_line(at_zero, width, subinterval, line.value);
  arb_set(line.rate[0], line.value[1]);
}

template <class T>
Grading<T> grading(const ProvenInterval& interval, const Subinterval& subinterval) {
  Grading<T> sigma{interval.interval.graded, T(1.0)};
  if (sigma.graded) set_line(interval.sigma, interval.width, subinterval, sigma.sigma);
  return sigma;
}

// The pilot's unknown, which is zero throughout where sigma tells its angle.
template <class T>
T pilot_of(const ProvenInterval& interval, const Subinterval& subinterval) {
  T x(0.0);
  if (!interval.interval.graded) set_line(0, interval.width, subinterval, x);
  return x;
}

// A guess with an error: powers above the degree are errors as well.
template <int Degree>
ArbModel<Degree> widened(const CheckGuess& guess, double error) {
  ArbModel<Degree> x;
  for (int k = 0; k <= Degree; ++k) arb_set_d(x[k], guess.c[k]);
  ArbNumber rest(error);
  for (int k = Degree + 1; k <= kCheckDegree; ++k) rest += size_of(ArbNumber(guess.c[k]));
  arb_add_error(x[0], rest[0]);
  return x;
}

// All unknowns, each within its error of its guess.
template <int Degree>
std::vector<ArbModel<Degree>> unknowns_within(const ProvenInterval& interval,
                                              const Subinterval& subinterval,
                                              const Eigen::VectorXd& errors) {
  std::vector<ArbModel<Degree>> x;
  for (std::size_t j = 0; j < subinterval.guess.size(); ++j) {
    x.push_back(widened<Degree>(subinterval.guess[j], errors[Eigen::Index(j)]));
  }
  x.push_back(pilot_of<ArbModel<Degree>>(interval, subinterval));
  return x;
}

CheckGuess derivative(const CheckGuess& f) {
  CheckGuess result;
  for (int k = 1; k <= kCheckDegree; ++k) result.c[k - 1] = k * f.c[k];
  return result;
}

// Perron's root of these sizes, approximately, and its vector r.
double perron(const Eigen::MatrixXd& sizes, Eigen::VectorXd& r) {
  constexpr double kSmallest = 0.05;
  r = Eigen::VectorXd::Ones(sizes.rows());
  for (int k = 0; k < 30; ++k) {
    const Eigen::VectorXd image = sizes * r;
    r = (image / image.maxCoeff()).cwiseMax(kSmallest);
  }
  r /= r.minCoeff();
  return ((sizes * r).array() / r.array()).maxCoeff();
}

}  // namespace

std::vector<ArbNumber> ProvenInterval::unknowns_at(const ArbNumber& s) const {
  std::vector<ArbNumber> x;
  for (const Subinterval& subinterval : subintervals) {
    const ArbNumber place = (s - ArbNumber(subinterval.middle)) / ArbNumber(subinterval.half);
    if (!(size_of(place) <= ArbNumber(1.0))) continue;
    for (std::size_t j = 0; j < subinterval.guess.size(); ++j) {
      x.push_back(value_at(widened<kCheckDegree>(subinterval.guess[j],
                                                 subinterval.error[static_cast<Eigen::Index>(j)]),
                           place));
    }
    x.push_back(interval.graded ? ArbNumber(0.0) : ArbNumber(width) * s);
    return x;
  }
  x.resize(subintervals.empty() ? 1 : subintervals[0].guess.size() + 1);
  for (ArbNumber& value : x) arb_indeterminate(value[0]);
  return x;
}

bool IntervalProver::find_middle(const ProvenInterval& interval, Eigen::VectorXd x,
                                 Subinterval& subinterval) {
  constexpr int kMostSteps = 20;
  constexpr double kLargestStep = 0.5, kSmallestStep = 1e-13;
  const int n = mechanism_.equations;
  const Grading<double> sigma = grading<double>(interval, subinterval);
  std::vector<double> unknowns(mechanism_.unknowns), residual;
  unknowns[n] = pilot_of<double>(interval, subinterval);
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMostSteps; ++step) {
    for (int j = 0; j < n; ++j) unknowns[j] = x[j];
    const PoseClosure closure(mechanism_, geometry_, interval.lines, sigma, unknowns);
    closure.open_by(residual, nullptr);
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(n, n);
    for (const auto& entry : closure.jacobian()) jacobian(entry.row, entry.column) += entry.value;
    inverse_ = jacobian.partialPivLu().inverse();
    const Eigen::VectorXd change = inverse_ * Eigen::Map<const Eigen::VectorXd>(residual.data(), n);
    const double size = change.lpNorm<Eigen::Infinity>();
    if (!(size < kLargestStep)) return false;
    x -= change;
    if (size < kSmallestStep || (size < 1e-9 && size > 0.5 * last)) {  // or rounding stops it
      subinterval.guess.assign(n, {});
      for (int j = 0; j < n; ++j) subinterval.guess[j].c[0] = x[j];
      return true;
    }
    last = size;
  }
  return false;
}

// Newton's method on polynomials with the middle's Jacobian gains a power of s at every step.
void IntervalProver::find_guess(const ProvenInterval& interval, Subinterval& subinterval) const {
  const int n = mechanism_.equations;
  const auto sigma = grading<CheckGuess>(interval, subinterval);
  std::vector<CheckGuess> x = subinterval.guess, residual;
  x.push_back(pilot_of<CheckGuess>(interval, subinterval));
  Eigen::MatrixXd coefficients(n, kCheckDegree + 1);
  for (int order = 0; order <= kCheckDegree; ++order) {
    PoseClosure(mechanism_, geometry_, interval.lines, sigma, x).open_by(residual, nullptr);
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k <= kCheckDegree; ++k) coefficients(i, k) = residual[i].c[k];
    }
    const Eigen::MatrixXd changes = inverse_ * coefficients;
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k <= kCheckDegree; ++k) x[i].c[k] -= changes(i, k);
    }
  }
  x.pop_back();
  subinterval.guess = std::move(x);
}

// Upper bounds of |C F(s)|, equation by equation.
std::vector<ArbNumber> IntervalProver::preconditioned(
    const std::vector<CheckModel>& residual) const {
  const std::size_t n = residual.size();
  std::vector<ArbNumber> most;
  for (std::size_t i = 0; i < n; ++i) {
    CheckModel sum;
    for (std::size_t j = 0; j < n; ++j) sum.add_product(arb_inverse_[i * n + j], residual[j]);
    most.push_back(most_of(sum));
  }
  return most;
}

// Finds upper bounds of |I - C J| all over the tube.
void IntervalProver::find_deviation(const ProvenInterval& interval,
                                    const Subinterval& subinterval) {
  using Entry = ArbModel<kCheckJacobianDegree>;
  const auto n = static_cast<std::size_t>(mechanism_.equations);
  const auto sigma = grading<Entry>(interval, subinterval);
  const auto x = unknowns_within<kCheckJacobianDegree>(interval, subinterval, subinterval.radius);
  const PoseClosure closure(mechanism_, arb_geometry_, interval.lines, sigma, x);
  std::vector<Entry> products(n * n);
  for (std::size_t i = 0; i < n; ++i) products[i * n + i] = Entry(-1.0);
  for (const auto& entry : closure.jacobian()) {
    const auto row = static_cast<std::size_t>(entry.row),
               j = static_cast<std::size_t>(entry.column);
    for (std::size_t i = 0; i < n; ++i) {
      products[i * n + j].add_product(arb_inverse_[i * n + row], entry.value);
    }
  }
  deviation_.clear();
  deviation_guess_.resize(mechanism_.equations, mechanism_.equations);
  for (std::size_t k = 0; k < n * n; ++k) {
    deviation_.push_back(most_of(products[k]));
    deviation_guess_(Eigen::Index(k / n), Eigen::Index(k % n)) = as_double(deviation_.back());
  }
}

bool IntervalProver::is_mapped_inside(const std::vector<ArbNumber>& misfit,
                                      const Eigen::VectorXd& radii) const {
  const std::size_t n = misfit.size();
  for (std::size_t i = 0; i < n; ++i) {
    ArbNumber sum = misfit[i];
    for (std::size_t j = 0; j < n; ++j) {
      sum.add_product(deviation_[i * n + j], ArbNumber(radii[Eigen::Index(j)]));
    }
    if (!(sum < ArbNumber(radii[Eigen::Index(i)]))) return false;
  }
  return true;
}

// Guesses radii slightly above the least that may be mapped inside.
Eigen::VectorXd IntervalProver::fixed_point(const std::vector<ArbNumber>& misfit) const {
  const Eigen::Index n = deviation_guess_.rows();
  Eigen::VectorXd m(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    m[i] = as_double(misfit[std::size_t(i)]);
  }
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(n, n) - deviation_guess_;
  constexpr double kMore = 1.01, kLeast = 1e-30;
  return (kMore * rest.partialPivLu().solve(m)).array() + kLeast;
}

bool IntervalProver::enclose(const ProvenInterval& interval, Subinterval& subinterval) {
  const auto sigma = grading<CheckModel>(interval, subinterval);
  const auto x = unknowns_within<kCheckDegree>(interval, subinterval,
                                               Eigen::VectorXd::Zero(mechanism_.equations));
  std::vector<CheckModel> residual;
  PoseClosure(mechanism_, arb_geometry_, interval.lines, sigma, x).open_by(residual, nullptr);
  const std::vector<ArbNumber> misfit = preconditioned(residual);
  double largest = 0;
  for (const ArbNumber& m : misfit) {
    largest = std::max(largest, arf_get_d(arb_midref(m[0]), ARF_RND_UP));
  }
  // The factor exceeds the rounding of the coordinates' middle.
  const double box = interval.interval.box * (1 + 1e-9);
  // Larger errors need shorter subintervals: the end must lie in the next interval's box, which may
  // be smaller.
  constexpr double kLargestError = 0.01;
  if (!(largest < kLargestError * box)) return false;
  double slack = 4 * largest;
  constexpr int kAttempts = 4;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    subinterval.radius = box * weights_.array() + slack;
    find_deviation(interval, subinterval);
    if (is_mapped_inside(misfit, subinterval.radius)) {
      subinterval.error = fixed_point(misfit);
      const Eigen::ArrayXd more = subinterval.radius - subinterval.error;
      if (!is_mapped_inside(misfit, subinterval.error)) return false;
      if ((subinterval.error.array() > 0).all() && (more >= box).all()) {
        return subinterval.error.maxCoeff() < kLargestError * box;
      }
      slack = 1.5 * subinterval.error.maxCoeff();
    } else if (!(perron(deviation_guess_, weights_) < 1)) {
      break;
    }
  }
  weights_.setOnes();
  return false;
}

bool IntervalProver::find_slopes(const ProvenInterval& interval, Subinterval& subinterval) {
  using Moving = WithRate<CheckModel>;
  const auto n = static_cast<std::size_t>(mechanism_.equations);
  const auto sigma = grading<Moving>(interval, subinterval);
  std::vector<Moving> x, residual, traces;
  for (std::size_t j = 0; j < n; ++j) {
    x.emplace_back(widened<kCheckDegree>(subinterval.guess[j], subinterval.error[Eigen::Index(j)]),
                   widened<kCheckDegree>(derivative(subinterval.guess[j]), 0));
  }
  x.push_back(pilot_of<Moving>(interval, subinterval));
  PoseClosure(mechanism_, arb_geometry_, interval.lines, sigma, x).open_by(residual, &traces);
  for (const Moving& trace :
       traces) {  // where R is symmetric it is I: no half turn has 3 - 4 < trace
    if (!(most_of(sigma(trace).value) < ArbNumber(4.0))) return false;
  }
  std::vector<CheckModel> rates;
  for (const Moving& row : residual) rates.push_back(row.rate);
  const std::vector<ArbNumber> misfit = preconditioned(rates);
  const Eigen::VectorXd errors = fixed_point(misfit);
  if (!is_mapped_inside(misfit, errors)) return false;
  for (std::size_t j = 0; j < n; ++j) {
    x[j].rate = widened<kCheckDegree>(derivative(subinterval.guess[j]), errors[Eigen::Index(j)]);
  }
  const PoseClosure closure(mechanism_, arb_geometry_, interval.lines, sigma, x);
  for (const Diagonal& diagonal : mechanism_.diagonals) {
    const Moving stretch = closure.squared_elongation(diagonal);
    subinterval.stretches.push_back(stretch.value);
    subinterval.slopes.push_back(sigma(stretch).rate);
  }
  for (std::size_t i = 0; i < mechanism_.creases.size(); ++i) {
    subinterval.cosines.push_back(closure.cosine(i).value);
    subinterval.sines.push_back(closure.sine(i).value);
  }
  return true;
}

std::vector<std::array<std::array<CheckModel, 3>, 4>> IntervalProver::place_panels(
    const ProvenInterval& interval, const Subinterval& subinterval, const FoldedShape& shape,
    const Panels& panels) const {
  const auto sigma = grading<CheckModel>(interval, subinterval);
  const auto x = unknowns_within<kCheckDegree>(interval, subinterval, subinterval.error);
  return PoseClosure(mechanism_, arb_geometry_, interval.lines, sigma, x)
      .place_panels(shape.tree(), panels.facets, panels.corners);
}

bool IntervalProver::prove_subinterval(const ProvenInterval& interval, const Eigen::VectorXd& start,
                                       Subinterval& subinterval) {
  if (!find_middle(interval, start, subinterval)) return false;
  find_guess(interval, subinterval);
  arb_inverse_.clear();
  for (const double entry : inverse_.transpose().reshaped()) arb_inverse_.emplace_back(entry);
  return enclose(interval, subinterval) && find_slopes(interval, subinterval);
}

}  // namespace misalign::solver
