// Gives three fold angles of a rigid vertex of degree four from the fourth in closed form, also if
// it is not flat-foldable. Sector angles add up to 360 degrees.
//
// Creases 1 to 4 counter-clockwise, sectors a between 1 and 2, b between 2 and 3, c, and d between
// 4 and 1, t_i = tan(rho_i / 2). From the spherical quadrilateral (its sides a to d, its exterior
// angles rho_i; Huffman 1976; for flat-foldable vertices Evans, Lang, Magleby & Howell 2015):
//   opposite  sin b sin c sin^2(rho_3 / 2) = sin a sin d sin^2(rho_1 / 2)
//   adjacent  sin a sin(b + d) t_1^2 t_2^2 + sin(a + b) sin d t_1^2 + sin(a + d) sin b t_2^2
//             + 2 sin b sin d t_1 t_2 = 0, and the same between 1 and 4 with a and d, b and c
//             exchanged
// Both have two solutions; the sign of rho_3 / rho_1 distinguishes the vertex' two ways of folding.
// Angles are kept as cosines and sines, so that nothing depends on a library's arc tangent.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "solver/pattern/half_angle.hpp"

namespace misalign::solver {

/// A vertex is flat-foldable if opposite sectors add up to 180 degrees within this (Kawasaki): its
/// tangent ratios are then constant. Coordinates written to 1e-4 mm on 80 mm panels leave 3e-6.
inline constexpr double kFlatFoldable_rad = 1e-5;

/// A crease that would be beyond 180 degrees by no more than this is closed (1e-5 degrees; cosines
/// of half fold angles, and roots of what their squares are, below zero by that much are zero): in
/// cosines rounding leaves 1e-15, in their squares 1e-16, whose root is 1e-8. Without it, rounding
/// would decide whether a sheet closes at 180 degrees.
inline constexpr double kClosed_rad = 1e-7;

class DegreeFourVertex {
 public:
  /// `creases` are unit directions in the sheet, counter-clockwise from the crease whose fold angle
  /// is given; each sector is below 180 degrees. `opposite_sign` is the sign of rho_3 / rho_1.
  DegreeFourVertex(const std::array<Eigen::Vector2d, 4>& creases, int opposite_sign);

  /// Signs of rho_2, rho_3, rho_4 when rho_1 is positive; none if the vertex cannot fold this way
  /// on all its creases.
  const std::optional<std::array<int, 3>>& signs() const { return signs_; }
  bool flat_foldable() const { return flat_foldable_; }
  int opposite_sign() const { return opposite_sign_; }

  /// rho_2, rho_3, rho_4; none if the vertex cannot fold that far, or if one of them would exceed
  /// 180 degrees by more than `closed_rad`.
  std::optional<std::array<HalfAngle<double>, 3>> others(const HalfAngle<double>& first,
                                                         double closed_rad = kClosed_rad) const;

 private:
  // Coefficients of the adjacent relation between crease 1 and crease 2 or 4.
  struct Adjacent {
    double p22, p20, p02, p11;
    bool minus_root;
    std::optional<HalfAngle<double>> follow(const HalfAngle<double>& first,
                                            double closed_rad) const;
  };

  Adjacent second_, fourth_;
  double opposite_square_;  // sin^2(rho_3 / 2) / sin^2(rho_1 / 2)
  int opposite_sign_;
  bool flat_foldable_;
  std::optional<std::array<int, 3>> signs_;
};

}  // namespace misalign::solver
