// Nests shapes on beds: each as low as it can lie, then as far left, turned as fits best.
#pragma once

#include <optional>
#include <vector>

#include "schema/nesting/nest_shape.hpp"

namespace misalign::schema {

struct NestBed {
  Eigen::Vector2d size_mm;  ///< the height may be infinite
  double gap_mm = 0;        ///< least distance of shapes from one another and from places taken
  std::vector<PlanePoints> taken = {};  ///< convex polygons on every bed
};

/// A shape's points are turned about the origin, then moved.
struct Nested {
  std::size_t bed = 0;
  double turned_deg = 0;
  Eigen::Vector2d moved_mm{0, 0};

  Eigen::Vector2d operator()(const Eigen::Vector2d& point) const {
    return turned(point, turned_deg) + moved_mm;
  }
};

struct NestResult {
  std::vector<Nested> places;  ///< one for each shape
  std::size_t beds = 0;
  std::vector<Eigen::Vector2d>
      used_mm;  ///< upper right corner of the part that is used, for each bed

  /// Returns whether it has fewer beds, or as many and less height used on the last.
  bool is_better_than(const NestResult& other) const;
};

/// The place of a shape on an empty bed; none if it does not fit.
std::optional<Nested> place_alone(const NestShape& shape, const NestBed& bed);

/// Places all shapes, of which each must fit an empty bed: the best of several orders, with the
/// fewest beds, then the least height used on the last. The shapes' outlines, not their boxes, keep
/// the gap; a small one may lie in another's opening. The result depends on nothing but the input.
NestResult nest(const std::vector<NestShape>& shapes, const NestBed& bed);

}  // namespace misalign::schema
