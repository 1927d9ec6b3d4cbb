// Translations of one convex polygon that bring it nearer to another than a gap.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {

/// An open interval of one coordinate.
struct OpenInterval {
  double low, high;
};

/// A no-fit polygon: the convex polygon of translations at which `moving` lies nearer than the gap
/// to `fixed`. Edges of both keep exactly the gap; at corners, where the true bound is an arc, at
/// most a fiftieth more.
class Forbidden {
 public:
  Forbidden(const PlanePoints& fixed, const PlanePoints& moving, double gap_mm);

  /// The open interval of the other coordinate where coordinate `axis` has a value; none beside
  /// the polygon.
  std::optional<OpenInterval> at(int axis, double value) const;
  const Eigen::Vector2d& least_mm() const { return least_mm_; }
  const Eigen::Vector2d& most_mm() const { return most_mm_; }

 private:
  PlanePoints corners_;
  Eigen::Vector2d least_mm_ = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()),
                  most_mm_ = -least_mm_;
};

/// The least value from `from` on, at most `to`, in none of the intervals; none if there is none.
std::optional<double> first_free(std::vector<OpenInterval> taken, double from, double to);

}  // namespace misalign::schema
