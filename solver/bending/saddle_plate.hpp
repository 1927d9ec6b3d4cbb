// The stiffness of a panel against the one way in which it bends: into a saddle, its creases
// straight.
#pragma once

#include <Eigen/Core>
#include <array>

namespace misalign::solver {

/// A saddle's size is q = sum of lambda_i w_i over the four corners, w_i their distances from the
/// plane and lambda_i twice the share of the area that the triangle without corner i has, of
/// alternating sign: 0 for every plane, 6 V / area with V the volume between the corners.
struct SaddlePlate {
  double area_mm2, perimeter_mm;
  /// Stiffness of a thin plate, 1/mm^2: energy = stiffness D q^2 / 2, with D = E t^3 / 12 (1 -
  /// nu^2).
  double stiffness;
};

/// The polynomials' degree in each direction. The stiffness of panels like the paper's falls from 5
/// to 7 by less than 2 %, most where two edges are free
/// (tests/solver/bending/saddle_plate_test.cpp).
inline constexpr int kRitzDegree = 5;
/// Bends a plate by the method of Ritz (polynomials of this degree in each direction): corners in
/// mm, counter-clockwise; `is_straight[i]`: the edge from corner i to the next is a crease, which
/// the neighbour keeps straight. Other edges are free. A rectangle whose edges all stay straight,
/// or are all free, has 2 (1 - nu) / area: pure twist.
SaddlePlate bend_into_saddle(const std::array<Eigen::Vector2d, 4>& corners_mm,
                             const std::array<bool, 4>& is_straight, double poisson,
                             int degree = kRitzDegree);

/// The largest von Mises stress at a face, farther than kCornerWidths of the panel's width (the
/// root of its area) from its corners, is E t / 2 (1 - nu^2) times this times |q|. 1/mm^2. At a
/// corner of alpha > 90 degrees between creases the stress of a thin plate has no limit: it grows
/// as r^(pi / alpha - 2) there (Williams 1952).
double saddle_stress(const std::array<Eigen::Vector2d, 4>& corners_mm,
                     const std::array<bool, 4>& is_straight, double poisson, int degree);
inline constexpr double kCornerWidths = 0.1;
/// The polynomials' degree for stress. Up to 11 the stress in panels like the paper's falls by at
/// most 8 % (tests/solver/bending/saddle_plate_test.cpp).
inline constexpr int kStressDegree = 7;

/// The volume (mm^6) under a clamped plate of this shape, load over rigidity 1/mm^4, by (1 - u^2)^2
/// (1 - v^2)^2 times nine polynomials: of a square 3.89e-4 a^6.
double volume_under_clamped(const std::array<Eigen::Vector2d, 4>& corners_mm);

}  // namespace misalign::solver
