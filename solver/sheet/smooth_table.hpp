// Interpolates smooth functions, known at equidistant places, by piecewise polynomials.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace misalign::solver {

/// Each is even or odd about 0, so that there is no end there. Between two places it is the
/// polynomial through the eight places around (those next to the end: through the last eight), so
/// that its error and its derivative's are about step^8 and step^7 times the eighth derivative.
class SmoothTable {
 public:
  static constexpr int kPoints = 8;
  enum class Parity { even, odd };

  /// `values` has a row for each function, and column k for the place (k + 1/2) * step: at least
  /// kPoints of them.
  SmoothTable(const Eigen::MatrixXd& values, std::vector<Parity> parities, double step);

  /// Number of places; end of the domain, half a step beyond the last.
  Eigen::Index places() const { return static_cast<Eigen::Index>(segments_.size()) - 1; }
  double end() const { return step_ * static_cast<double>(places()); }
  Eigen::Index functions() const { return static_cast<Eigen::Index>(parities_.size()); }

  /// `count` functions from `first` on, and their derivatives, at x in [-end(), end()].
  void find(double x, Eigen::Index first, Eigen::Index count, Eigen::VectorXd& values,
            Eigen::VectorXd& slopes) const;
  /// A single one's value.
  double value(double x, Eigen::Index function) const;

 private:
  using Segment = Eigen::Matrix<double, Eigen::Dynamic, kPoints>;
  // The segment for |x|, and x in steps from its middle.
  std::pair<const Segment&, double> at(double x) const;

  double step_;
  std::vector<Parity> parities_;
  Eigen::VectorXd mirrored_;       // +-1: what a function is multiplied by on the other side
  std::vector<Segment> segments_;  // coefficients of powers of x in steps; the k-th about k * step
};

}  // namespace misalign::solver
