#include "solver/bending/saddle_plate.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

double area_of(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Gauss and Legendre's points and weights on [-1, 1], by the eigenvalues of Legendre's recurrence
// (Golub & Welsch 1969).
struct Quadrature {
  explicit Quadrature(int count) {
    assert(count > 0);
    MatrixXd recurrence = MatrixXd::Zero(count, count);
    for (int k = 1; k < count; ++k) {
      recurrence(k, k - 1) = recurrence(k - 1, k) = k / std::sqrt(4.0 * k * k - 1);
    }
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solved(recurrence);
    points = solved.eigenvalues();
    weights = 2 * solved.eigenvectors().row(0).cwiseAbs2().transpose();
  }
  VectorXd points, weights;
};

// Functions along one direction of the square [-1, 1]^2, at the quadrature's points (rows), with
// first and second derivatives: the two linear ones, then (1 - s^2) L_k(s), which vanish at both
// ends.
struct Ladder {
  Ladder(const VectorXd& s, int degree)
      : value(s.size(), degree + 1), slope(s.size(), degree + 1), bend(s.size(), degree + 1) {
    for (Index i = 0; i < s.size(); ++i) {
      const double x = s(i);
      value.row(i).head<2>() << (1 - x) / 2, (1 + x) / 2;
      slope.row(i).head<2>() << -0.5, 0.5;
      bend.row(i).head<2>().setZero();
      double p0 = 1, p1 = x, d0 = 0, d1 = 1, e0 = 0, e1 = 0;  // Legendre, and its derivatives
      for (int k = 2; k <= degree; ++k) {
        const double round = 1 - x * x;
        value(i, k) = round * p0;
        slope(i, k) = round * d0 - 2 * x * p0;
        bend(i, k) = round * e0 - 4 * x * d0 - 2 * p0;
        const double n = k - 1;
        const double p2 = ((2 * n + 1) * x * p1 - n * p0) / (n + 1);
        const double d2 = d0 + (2 * n + 1) * p1, e2 = e0 + (2 * n + 1) * d1;
        p0 = p1, p1 = p2, d0 = d1, d1 = d2, e0 = e1, e1 = e2;
      }
    }
  }
  MatrixXd value, slope, bend;
};

// Everything that depends on the degree alone.
struct Rule {
  explicit Rule(int degree_) : degree(degree_), gauss(degree_ + 2), ladder(gauss.points, degree_) {}
  int degree;
  Quadrature gauss;
  Ladder ladder;
};

const Rule& rule_of(int degree) {
  static const Rule usual(kRitzDegree);
  if (degree == kRitzDegree) return usual;
  thread_local Rule other(degree);
  if (other.degree != degree) other = Rule(degree);
  return other;
}

// A function of the plate: a product of one function in each direction.
struct Product {
  int u, v;
};

// Functions that keep the corners in place and creases straight. Edges in turn: v low, u high, v
// high, u low.
std::vector<Product> free_functions(int degree, const std::array<bool, 4>& is_straight) {
  assert(degree >= 2);
  std::vector<Product> functions;
  for (int k = 2; k <= degree; ++k) {
    if (!is_straight[0]) functions.push_back({k, 0});
    if (!is_straight[1]) functions.push_back({1, k});
    if (!is_straight[2]) functions.push_back({k, 1});
    if (!is_straight[3]) functions.push_back({0, k});
    for (int m = 2; m <= degree; ++m) functions.push_back({k, m});
  }
  return functions;
}

class Plate {
 public:
  Plate(const std::array<Vector2d, 4>& corners_mm, const std::array<bool, 4>& is_straight,
        const Rule& rule)
      : c_(corners_mm), rule_(rule), functions_(free_functions(rule.degree, is_straight)) {}

  double area() const { return area_of(c_[2] - c_[0], c_[3] - c_[1]) / 2; }
  double perimeter() const {
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += (c_[(i + 1) % 4] - c_[i]).norm();
    return sum;
  }

  // Displacements of the corners in a saddle of size 1, orthogonal to every plane.
  std::array<double, 4> corners_of_saddle() const {
    std::array<double, 4> lambda{};
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      const Vector2d &a = c_[(i + 1) % 4], &b = c_[(i + 2) % 4], &d = c_[(i + 3) % 4];
      lambda[i] = (i % 2 ? -1 : 1) * area_of(b - a, d - a) / area();
      sum += lambda[i] * lambda[i];
    }
    for (double& w : lambda) w /= sum;
    return lambda;
  }

  // Curvatures w_xx, w_yy, 2 w_xy at a point of the square, of functions with these w_u, w_v and
  // w_uu, w_vv, w_uv, a column each.
  MatrixXd curvatures(double u, double v, const MatrixXd& slopes, MatrixXd seconds) const;
  Vector2d place_mm(double u, double v) const {
    return middle_ + u * along_u_ + v * along_v_ + u * v * both_;
  }
  double stretch(double u, double v) const {  // ratio of areas
    return area_of(along_u_ + v * both_, along_v_ + u * both_);
  }
  const std::vector<Product>& functions() const { return functions_; }

  // The same at every point of the rule: three rows a point, a column for the saddle's corners and
  // one for each function. Rows' weights: sqrt(weight * det).
  void find_curvatures(MatrixXd& curvatures, VectorXd& weights) const;

 private:
  const std::array<Vector2d, 4>& c_;
  const Rule& rule_;
  const std::vector<Product> functions_;
  const Vector2d middle_ = (c_[0] + c_[1] + c_[2] + c_[3]) / 4,
                 along_u_ = (c_[1] - c_[0] + c_[2] - c_[3]) / 4,
                 along_v_ = (c_[3] - c_[0] + c_[2] - c_[1]) / 4,
                 both_ = (c_[0] - c_[1] + c_[2] - c_[3]) / 4;
};

MatrixXd Plate::curvatures(double u, double v, const MatrixXd& slopes, MatrixXd seconds) const {
  const Vector2d xu = along_u_ + v * both_, xv = along_v_ + u * both_;
  Eigen::Matrix2d jacobian;
  jacobian.row(0) = xu;
  jacobian.row(1) = xv;
  Eigen::Matrix3d turned;  // w_uu, w_vv, w_uv from w_xx, w_yy, 2 w_xy, without the slopes' part
  turned << xu.x() * xu.x(), xu.y() * xu.y(), xu.x() * xu.y(),  //
      xv.x() * xv.x(), xv.y() * xv.y(), xv.x() * xv.y(),        //
      xu.x() * xv.x(), xu.y() * xv.y(), (xu.x() * xv.y() + xu.y() * xv.x()) / 2;
  const Eigen::RowVector2d bends = both_.transpose() * jacobian.inverse();
  seconds.row(2) -= bends * slopes;
  return turned.inverse() * seconds;
}

void Plate::find_curvatures(MatrixXd& curvatures, VectorXd& weights) const {
  const Index n = rule_.gauss.points.size();
  const auto count = static_cast<Index>(functions_.size());
  const std::array<double, 4> w = corners_of_saddle();
  const double twist = (w[0] - w[1] + w[2] - w[3]) / 4;  // coefficient of u v in the bilinear part
  const double tilt_u = (w[1] - w[0] + w[2] - w[3]) / 4, tilt_v = (w[3] - w[0] + w[2] - w[1]) / 4;
  curvatures.resize(3 * n * n, count + 1);
  weights.resize(3 * n * n);
  const Ladder& at = rule_.ladder;
  MatrixXd seconds(3, count + 1), slopes(2, count + 1);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const double u = rule_.gauss.points(i), v = rule_.gauss.points(j);
      slopes.col(0) << tilt_u + twist * v, tilt_v + twist * u;
      seconds.col(0) << 0, 0, twist;
      for (Index k = 0; k < count; ++k) {
        const auto [a, b] = functions_[static_cast<std::size_t>(k)];
        slopes.col(k + 1) << at.slope(i, a) * at.value(j, b), at.value(i, a) * at.slope(j, b);
        seconds.col(k + 1) << at.bend(i, a) * at.value(j, b), at.value(i, a) * at.bend(j, b),
            at.slope(i, a) * at.slope(j, b);
      }
      const Index row = 3 * (i * n + j);
      curvatures.middleRows<3>(row) = this->curvatures(u, v, slopes, seconds);
      weights.segment<3>(row).setConstant(
          std::sqrt(rule_.gauss.weights(i) * rule_.gauss.weights(j) * stretch(u, v)));
    }
  }
}

// A saddle of size 1 in equilibrium: the functions' coefficients, and its stiffness.
struct Relaxed {
  VectorXd amounts;
  double stiffness;
};

Relaxed relax(const Plate& plate, double poisson) {
  assert(poisson > -1 && poisson < 1);
  MatrixXd rooted;
  VectorXd weights;
  plate.find_curvatures(rooted, weights);
  // Energy = half of the square of these: (w_xx + nu w_yy, root(1 - nu^2) w_yy, root((1 - nu) / 2)
  // 2 w_xy).
  const double side = std::sqrt(1 - poisson * poisson), shear = std::sqrt((1 - poisson) / 2);
  for (Index row = 0; row < rooted.rows(); row += 3) {
    rooted.row(row) += poisson * rooted.row(row + 1);
    rooted.row(row + 1) *= side;
    rooted.row(row + 2) *= shear;
  }
  rooted.array().colwise() *= weights.array();
  const auto functions = rooted.rightCols(rooted.cols() - 1);
  MatrixXd stiffness = MatrixXd::Zero(functions.cols(), functions.cols());
  stiffness.selfadjointView<Eigen::Lower>().rankUpdate(functions.transpose());
  const VectorXd pushed = functions.transpose() * rooted.col(0);
  const VectorXd amounts = -stiffness.selfadjointView<Eigen::Lower>().llt().solve(pushed);
  return {amounts, rooted.col(0).squaredNorm() + amounts.dot(pushed)};
}

// (1 - s^2)^2 s^k for k = 0, 1, 2, with first and second derivatives.
struct Clamped {
  explicit Clamped(double s) {
    const double round = 1 - s * s;
    const double value_0 = round * round, slope_0 = -4 * s * round, bend_0 = 12 * s * s - 4;
    value << value_0, s * value_0, s * s * value_0;
    slope << slope_0, value_0 + s * slope_0, 2 * s * value_0 + s * s * slope_0;
    bend << bend_0, 2 * slope_0 + s * bend_0, 2 * value_0 + 4 * s * slope_0 + s * s * bend_0;
  }
  Eigen::RowVector3d value, slope, bend;
};

Eigen::RowVectorXd products(const Eigen::RowVector3d& u, const Eigen::RowVector3d& v) {
  return (u.transpose() * v).reshaped().transpose();
}

}  // namespace

SaddlePlate bend_into_saddle(const std::array<Vector2d, 4>& corners_mm,
                             const std::array<bool, 4>& is_straight, double poisson, int degree) {
  const Plate plate(corners_mm, is_straight, rule_of(degree));
  return {plate.area(), plate.perimeter(), relax(plate, poisson).stiffness};
}

double saddle_stress(const std::array<Vector2d, 4>& corners_mm,
                     const std::array<bool, 4>& is_straight, double poisson, int degree) {
  const Plate plate(corners_mm, is_straight, rule_of(degree));
  const VectorXd amounts = relax(plate, poisson).amounts;
  MatrixXd coefficients = MatrixXd::Zero(degree + 1, degree + 1);  // one per product
  for (std::size_t k = 0; k < plate.functions().size(); ++k) {
    coefficients(plate.functions()[k].u, plate.functions()[k].v) = amounts(static_cast<Index>(k));
  }
  const std::array<double, 4> w = plate.corners_of_saddle();
  coefficients(0, 0) = w[0], coefficients(1, 0) = w[1], coefficients(1, 1) = w[2],
                  coefficients(0, 1) = w[3];
  constexpr int kSide = 41;  // points in each direction: stress changes by 1 % from one to the next
  const VectorXd places = VectorXd::LinSpaced(kSide, -1, 1);
  const Ladder at(places, degree);
  const MatrixXd w_u = at.slope * coefficients * at.value.transpose(),
                 w_v = at.value * coefficients * at.slope.transpose(),
                 w_uu = at.bend * coefficients * at.value.transpose(),
                 w_vv = at.value * coefficients * at.bend.transpose(),
                 w_uv = at.slope * coefficients * at.slope.transpose();
  const double disc_mm = kCornerWidths * std::sqrt(plate.area());
  double largest = 0;
  for (Index i = 0; i < kSide; ++i) {
    for (Index j = 0; j < kSide; ++j) {
      const double u = places(i), v = places(j);
      const Vector2d place_mm = plate.place_mm(u, v);
      if (std::any_of(corners_mm.begin(), corners_mm.end(), [&](const Vector2d& corner_mm) {
            return (place_mm - corner_mm).norm() < disc_mm;
          })) {
        continue;
      }
      const Eigen::Vector3d bent =
          plate.curvatures(u, v, Vector2d(w_u(i, j), w_v(i, j)),
                           Eigen::Vector3d(w_uu(i, j), w_vv(i, j), w_uv(i, j)));
      const double x = bent(0) + poisson * bent(1), y = bent(1) + poisson * bent(0),
                   xy = (1 - poisson) / 2 * bent(2);
      largest = std::max(largest, std::sqrt(x * x - x * y + y * y + 3 * xy * xy));
    }
  }
  return largest;
}

double volume_under_clamped(const std::array<Vector2d, 4>& corners_mm) {
  const Rule& rule = rule_of(kRitzDegree);
  const Plate plate(corners_mm, {true, true, true, true}, rule);
  Eigen::Matrix<double, 9, 9> stiffness = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 1> volumes = Eigen::Matrix<double, 9, 1>::Zero();
  MatrixXd slopes(2, 9), seconds(3, 9);
  for (Index i = 0; i < rule.gauss.points.size(); ++i) {
    for (Index j = 0; j < rule.gauss.points.size(); ++j) {
      const double u = rule.gauss.points(i), v = rule.gauss.points(j);
      const Clamped along_u(u), along_v(v);
      slopes << products(along_u.slope, along_v.value), products(along_u.value, along_v.slope);
      seconds << products(along_u.bend, along_v.value), products(along_u.value, along_v.bend),
          products(along_u.slope, along_v.slope);
      const MatrixXd curvatures = plate.curvatures(u, v, slopes, seconds);
      const Eigen::RowVectorXd sum = curvatures.row(0) + curvatures.row(1);
      const double weight = rule.gauss.weights(i) * rule.gauss.weights(j) * plate.stretch(u, v);
      stiffness += weight * sum.transpose() * sum;
      volumes += weight * products(along_u.value, along_v.value).transpose();
    }
  }
  return volumes.dot(stiffness.llt().solve(volumes));
}

}  // namespace misalign::solver
