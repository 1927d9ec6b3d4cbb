// An elastic panel as a structure of its four corners: it bends into a saddle, and stretches and
// shears a little in its plane.
#pragma once

#include <Eigen/Core>
#include <array>

#include "solver/bending/saddle_plate.hpp"

namespace misalign::solver {

/// The paper's material, section 5: aluminium.
struct PanelMaterial {
  double e_gpa = 70;
  double poisson = 0.33;

  double e_mpa() const { return 1e3 * e_gpa; }
};

/// A panel stretches along a side like a strip with this share of its width: forces enter at
/// corners. The share was fitted to Table 1 (results/bending/README.md) and tested on other sheets.
inline constexpr double kEdgeShare = 0.12;
/// A plate that twists loses 0.315 t of its width at each edge (Saint-Venant).
inline constexpr double kFreeEdge = 0.315;

/// Adds second derivatives by the differences of two points each, three coordinates a point.
template <class Matrix>
void add_ends(int head, int tail, int other_head, int other_tail, const Eigen::Matrix3d& block,
              Matrix& bend) {
  bend.template block<3, 3>(3 * head, 3 * other_head) += block;
  bend.template block<3, 3>(3 * tail, 3 * other_tail) += block;
  bend.template block<3, 3>(3 * head, 3 * other_tail) -= block;
  bend.template block<3, 3>(3 * tail, 3 * other_head) -= block;
}

class ElasticPanel {
 public:
  using Corners = Eigen::Matrix<double, 3, 4>;
  /// A function of the corners with its derivatives.
  struct Function {
    double value = 0;
    Eigen::Matrix<double, 12, 1> slope = Eigen::Matrix<double, 12, 1>::Zero();
    Eigen::Matrix<double, 12, 12> bend = Eigen::Matrix<double, 12, 12>::Zero();
  };

  /// Corners of the flat panel are as in bend_into_saddle(). `stiffer` multiplies the stiffness in
  /// its plane.
  ElasticPanel(const std::array<Eigen::Vector2d, 4>& corners_mm,
               const std::array<bool, 4>& is_straight, const PanelMaterial& material,
               double thickness_mm, double stiffer);

  double area_mm2() const { return area_mm2_; }
  /// The saddle's size q.
  Function saddle(const Corners& p) const;
  /// Stiffness K of the saddle, N/mm.
  double saddle_n_per_mm() const { return saddle_n_per_mm_; }
  /// The largest von Mises stress at its faces for each mm of q, away from its corners
  /// (saddle_stress).
  double stress_mpa_per_mm() const;

  /// Squares of the sides and diagonals, less those of the flat panel, where corners moved from p,
  /// to first order.
  using Squares = Eigen::Matrix<double, 6, 1>;
  Squares squares_mm2(const Corners& p, const Corners& moved) const;
  /// The panel's energy, N mm. Second derivatives are those with the forces in its plane at
  /// `squares_mm2`.
  Function energy(const Corners& p, const Squares& squares_mm2) const;

 private:
  struct Bar {  // between two corners
    int tail, head;
    double flat_mm;
  };

  std::array<Eigen::Vector2d, 4> corners_mm_;
  std::array<bool, 4> is_straight_;  // edges from each corner to the next
  PanelMaterial material_;
  double thickness_mm_, area_mm2_, saddle_n_per_mm_;
  std::array<Bar, 6> bars_;  // four sides, two diagonals
  std::array<double, 4> side_n_per_mm_;
  std::array<double, 6> shear_;  // weights of the bars' squares in the shear angle
  double shear_n_mm_, stretch_n_per_mm3_;
};

}  // namespace misalign::solver
