// Gives the energy of one hole's filling as a function of the hole's diagonals.
//
// A hole with rigid edges AB, BC, CD, DA keeps the product of its diagonals' vectors,
// (|AD|^2 + |BC|^2 - |AB|^2 - |CD|^2) / 2: its shape follows from the two lengths alone.
#pragma once

#include <Eigen/Core>

namespace misalign::solver {

/// Energy, its derivatives by the two diagonals' lengths, and that by the diagonals' product, which
/// is constant but whose force acts on the edges.
struct HoleEnergy {
  double n_mm = 0;
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();  ///< positive where it pulls
  Eigen::Matrix2d n_per_mm = Eigen::Matrix2d::Zero();
  double across_n_per_mm = 0;
};

/// A hole's shape: squares of its diagonals' lengths and the product of their vectors, mm^2 (the
/// Gram matrix of the diagonals).
struct HoleShape {
  double first_mm2, second_mm2, product_mm2;
  double determinant() const { return first_mm2 * second_mm2 - product_mm2 * product_mm2; }
};

/// The state of a membrane.
enum class Tension {
  both,      ///< tense in both directions
  wrinkled,  ///< tense in one direction, wrinkled across it
  slack      ///< no stress
};

/// A plate of incompressible neo-Hookean rubber under the mean deformation of its hole. With
/// C = rest^-1 shape, I1 = tr C, J^2 = det C and principal stretches l1 >= l2 in its plane, the
/// energy is
///   G t A0 / 2 (I1 + 1 / J^2 - 3),   tense in both directions,
///   G t A0 / 2 (l1^2 + 2 / l1 - 3),  wrinkled, where l2^2 < 1 / l1,
/// and 0 where l1 <= 1 too: the relaxed energy of Pipkin (IMA J. Appl. Math. 36, 1986, 85). It is
/// exact for homogeneous deformations, that is for parallelograms in a plane.
class PlateLaw {
 public:
  /// `shear_n_per_mm`: shear modulus times thickness; `rest`: the hole's shape that is free of
  /// stress.
  PlateLaw(double shear_n_per_mm, const HoleShape& rest);

  /// The hole's shape that is free of stress.
  const HoleShape& rest() const { return rest_; }
  HoleEnergy at(const Eigen::Vector2d& lengths_mm, double product_mm2) const;

  struct Stretches {
    double largest, least;
    Tension tension;
  };
  Stretches stretches(const HoleShape& shape) const;

 private:
  // C - 1 in a frame of the plane at rest.
  Eigen::Matrix2d strain(const HoleShape& shape) const;

  HoleShape rest_;
  double factor_n_mm_;            // G t A0 / 2
  Eigen::Matrix2d to_diagonals_;  // the frame's axes as sums of the diagonals at rest, by columns
};

}  // namespace misalign::solver
