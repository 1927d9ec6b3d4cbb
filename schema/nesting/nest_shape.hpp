// A shape to nest: convex pieces that cover a part's material, and the angles to turn it by.
#pragma once

#include <vector>

#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {

/// The turns that a shape may make.
enum class NestTurns {
  any,   ///< edges along the bed's sides, each way round
  half,  ///< half turns: the material has a grain
};

struct NestShape {
  std::vector<PlanePoints> pieces;  ///< convex, counter-clockwise; they cover the material
  double area_mm2;                  ///< area of the material
  std::vector<double> turns_deg;    ///< counter-clockwise; the first is 0

  /// The shape turned about the origin.
  std::vector<PlanePoints> turned(double turn_deg) const;
};

/// A shape of contours with the material on their left: outer ones counter-clockwise, openings
/// clockwise; they may touch. Pieces exceed the material by at most 4 mm^2 at a corner of an arc or
/// a slot, which they replace by fewer corners.
NestShape nest_shape(const std::vector<PlanePoints>& rings, NestTurns turns = NestTurns::any);

/// A point turned about the origin, counter-clockwise; exactly by multiples of 90 degrees.
Eigen::Vector2d turned(const Eigen::Vector2d& point, double turn_deg);

}  // namespace misalign::schema
