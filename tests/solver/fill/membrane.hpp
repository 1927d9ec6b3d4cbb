// A hole's rubber plate as a membrane of finite elements, for tests: it shares no code with the
// program.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace misalign::solver {

/// Linear triangles, two to a cell of a grid that bilinear maps lay over a quadrilateral, of
/// incompressible neo-Hookean rubber. Nodes on the edges are bonded to straight edges, at equal
/// shares of them; the others rest where the energy is least.
class Membrane {
 public:
  enum class Wrinkles { relaxed, resolved };  ///< Pipkin's relaxed energy; or it buckles by itself

  using Corners = Eigen::Matrix<double, 3, 4>;

  /// Makes the membrane of a stress-free shape in the plane, corners in their order.
  Membrane(double shear_n_per_mm, const Eigen::Matrix<double, 2, 4>& rest_mm, Wrinkles wrinkles,
           int cells = 8)
      : shear_(shear_n_per_mm), wrinkles_(wrinkles), cells_(cells) {
    const Eigen::Matrix2Xd nodes_mm = grid(rest_mm);
    for (int i = 0; i < cells; ++i) {
      for (int k = 0; k < cells; ++k) {
        const int a = node(i, k), b = node(i, k + 1), c = node(i + 1, k + 1), d = node(i + 1, k);
        const bool turned = (i + k) % 2 == 1;
        add_triangle(nodes_mm, turned ? std::array{a, b, d} : std::array{a, b, c});
        add_triangle(nodes_mm, turned ? std::array{b, c, d} : std::array{a, c, d});
      }
    }
    for (int i = 1; i < cells; ++i) {
      for (int k = 1; k < cells; ++k) free_.push_back(node(i, k));
    }
  }

  struct Solution {
    double energy_n_mm;
    /// Forces of the plate on the corners, by the virtual work of edges that stay straight.
    Corners corner_forces_n;
    double unbalanced_n;  ///< largest force on a free node
  };

  Solution solve(const Corners& corners_mm) const {
    Eigen::Matrix3Xd at_mm = grid(corners_mm);
    if (wrinkles_ == Wrinkles::resolved) disturb(corners_mm, at_mm);
    double damping = 1e-6 * shear_, energy = energy_of(at_mm);
    Eigen::VectorXd slope = slope_of(at_mm);
    for (int i = 0; i < 300 && slope.cwiseAbs().maxCoeff() > 1e-8 * shear_; ++i) {
      const Eigen::MatrixXd second = second_of(at_mm);
      for (; damping < 1e6 * shear_; damping *= 4) {
        const auto count = slope.size();
        const Eigen::LLT<Eigen::MatrixXd> factors(
            second + damping * Eigen::MatrixXd::Identity(count, count));
        if (factors.info() != Eigen::Success) continue;
        const Eigen::VectorXd step = factors.solve(-slope);
        Eigen::Matrix3Xd there_mm = at_mm;
        for (std::size_t f = 0; f < free_.size(); ++f) {
          there_mm.col(free_[f]) += step.segment<3>(3 * static_cast<Eigen::Index>(f));
        }
        const double less = energy_of(there_mm);
        if (!(less <= energy + 1e-14 * std::abs(energy))) continue;
        at_mm = there_mm, energy = less;
        damping = std::max(damping / 16, 1e-9 * shear_);
        break;
      }
      slope = slope_of(at_mm);
    }
    return {energy, corner_forces(at_mm), slope.cwiseAbs().maxCoeff()};
  }

 private:
  struct Triangle {
    std::array<int, 3> nodes;
    Eigen::Matrix2d inverse;  // of its edges at rest
    double area;
  };

  int node(int i, int k) const { return i * (cells_ + 1) + k; }

  template <int kRows>
  Eigen::Matrix<double, kRows, Eigen::Dynamic> grid(
      const Eigen::Matrix<double, kRows, 4>& corners) const {
    Eigen::Matrix<double, kRows, Eigen::Dynamic> nodes(kRows, (cells_ + 1) * (cells_ + 1));
    for (int i = 0; i <= cells_; ++i) {
      for (int k = 0; k <= cells_; ++k) nodes.col(node(i, k)) = corners * shares(i, k);
    }
    return nodes;
  }
  Eigen::Vector4d shares(int i, int k) const {
    const double u = static_cast<double>(k) / cells_, v = static_cast<double>(i) / cells_;
    return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
  }

  void add_triangle(const Eigen::Matrix2Xd& at, const std::array<int, 3>& nodes) {
    Eigen::Matrix2d edges;
    edges << at.col(nodes[1]) - at.col(nodes[0]), at.col(nodes[2]) - at.col(nodes[0]);
    triangles_.push_back({nodes, edges.inverse(), std::abs(edges.determinant()) / 2});
  }

  void disturb(const Corners& corners, Eigen::Matrix3Xd& at) const {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> shift(-1, 1);
    const Eigen::Vector3d first = corners.col(2) - corners.col(0),
                          second = corners.col(3) - corners.col(1);
    for (const int n : free_) at.col(n) += shift(random) * first.cross(second).normalized();
  }

  static Eigen::Matrix<double, 3, 2> gradient(const Triangle& triangle,
                                              const Eigen::Matrix3Xd& at) {
    Eigen::Matrix<double, 3, 2> edges;
    edges << at.col(triangle.nodes[1]) - at.col(triangle.nodes[0]),
        at.col(triangle.nodes[2]) - at.col(triangle.nodes[0]);
    return edges * triangle.inverse;
  }

  struct Stretched {
    Eigen::Vector2d squares;  // of the stretches, ascending
    Eigen::Matrix2d axes;
    bool is_tense;
  };
  Stretched stretched(const Eigen::Matrix<double, 3, 2>& f) const {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solved;
    solved.computeDirect(f.transpose() * f);
    const Eigen::Vector2d squares = solved.eigenvalues();
    const bool is_tense =
        wrinkles_ == Wrinkles::resolved || squares(0) * squares(0) * squares(1) >= 1;
    return {squares, solved.eigenvectors(), is_tense};
  }

  double energy_of(const Eigen::Matrix3Xd& at) const {
    double sum = 0;
    for (const Triangle& triangle : triangles_) {
      const Stretched s = stretched(gradient(triangle, at));
      const double largest = std::sqrt(s.squares(1));
      const double density = s.is_tense    ? s.squares.sum() + 1 / s.squares.prod() - 3
                             : largest > 1 ? s.squares(1) + 2 / largest - 3
                                           : 0;
      sum += shear_ / 2 * triangle.area * density;
    }
    return sum;
  }

  // Forces of a triangle on its corners, reversed.
  Eigen::Matrix3d slopes(const Triangle& triangle, const Eigen::Matrix3Xd& at) const {
    const Eigen::Matrix<double, 3, 2> f = gradient(triangle, at);
    const Stretched s = stretched(f);
    Eigen::Vector2d by_squares = Eigen::Vector2d::Zero();
    if (s.is_tense) {
      by_squares = 1 - (s.squares * s.squares.prod()).cwiseInverse().array();
    } else if (s.squares(1) > 1) {
      by_squares(1) = 1 - std::pow(s.squares(1), -1.5);
    }
    const Eigen::Matrix<double, 3, 2> of_edges = shear_ * triangle.area * f * s.axes *
                                                 by_squares.asDiagonal() * s.axes.transpose() *
                                                 triangle.inverse.transpose();
    Eigen::Matrix3d all;
    all << -of_edges.rowwise().sum(), of_edges;
    return all;
  }

  Eigen::VectorXd slope_of(const Eigen::Matrix3Xd& at) const {
    Eigen::Matrix3Xd all = Eigen::Matrix3Xd::Zero(3, at.cols());
    for (const Triangle& triangle : triangles_)
      all(Eigen::all, triangle.nodes) += slopes(triangle, at);
    const Eigen::Matrix3Xd free = all(Eigen::all, free_);
    return free.reshaped();
  }

  // The stiffness by central differences of the slopes of each triangle.
  Eigen::MatrixXd second_of(Eigen::Matrix3Xd at) const {
    std::vector<Eigen::Index> place(static_cast<std::size_t>(at.cols()), -1);
    for (std::size_t f = 0; f < free_.size(); ++f) {
      place[static_cast<std::size_t>(free_[f])] = 3 * static_cast<Eigen::Index>(f);
    }
    const auto count = 3 * static_cast<Eigen::Index>(free_.size());
    Eigen::MatrixXd second = Eigen::MatrixXd::Zero(count, count);
    constexpr double kStep_mm = 1e-5;
    for (const Triangle& triangle : triangles_) {
      for (int n = 0; n < 3; ++n) {
        const Eigen::Index column =
            place[static_cast<std::size_t>(triangle.nodes[static_cast<std::size_t>(n)])];
        if (column < 0) continue;
        for (int k = 0; k < 3; ++k) {
          double& x = at(k, triangle.nodes[static_cast<std::size_t>(n)]);
          const double here = x;
          x = here + kStep_mm;
          Eigen::Matrix3d change = slopes(triangle, at);
          x = here - kStep_mm;
          change -= slopes(triangle, at);
          x = here;
          for (int m = 0; m < 3; ++m) {
            const Eigen::Index row =
                place[static_cast<std::size_t>(triangle.nodes[static_cast<std::size_t>(m)])];
            if (row >= 0) second.col(column + k).segment<3>(row) += change.col(m) / (2 * kStep_mm);
          }
        }
      }
    }
    return (second + second.transpose()) / 2;
  }

  Corners corner_forces(const Eigen::Matrix3Xd& at) const {
    Eigen::Matrix3Xd all = Eigen::Matrix3Xd::Zero(3, at.cols());
    for (const Triangle& triangle : triangles_)
      all(Eigen::all, triangle.nodes) += slopes(triangle, at);
    Corners forces = Corners::Zero();
    for (int i = 0; i <= cells_; ++i) {
      for (int k = 0; k <= cells_; ++k) {
        const bool is_bonded = i == 0 || k == 0 || i == cells_ || k == cells_;
        if (is_bonded) forces -= all.col(node(i, k)) * shares(i, k).transpose();
      }
    }
    return forces;
  }

  double shear_;
  Wrinkles wrinkles_;
  int cells_;
  std::vector<Triangle> triangles_;
  std::vector<int> free_;
};

}  // namespace misalign::solver
