// Follows a folding way until a gap closes (conservative advancement, Mirtich 1996, along one
// direction at a time): certain between any two places, not only at them.
//
// Seen from one panel, take the direction in which the other is nearest. Along it each corner of
// the other has a distance, and a rate that is known at nodes along the way. Between two nodes a
// rate is the straight line through both within h^2/8 of its second derivative, which its second
// differences tell. So the gap is at least a parabola, and open up to where that has its first
// root. There the gap is measured again.
#pragma once

#include <array>
#include <limits>

#include "solver/contact/panel_motion.hpp"

namespace misalign::solver {

/// Rates between two nodes differ from a straight line by an eighth of the larger of the second
/// differences at both, times this (up to 7.9 was seen: results/deployment/contact.md).
inline constexpr double kRateSafety = 20;
/// Error of the nodes' rates, per mm and unit of x: up to 3e-7 next to flat, where states are
/// singular.
inline constexpr double kRateError = 1e-6;

class GapWalk {
 public:
  virtual ~GapWalk() = default;

  /// Moves to x, from where gaps are bounded from now on: the gap there, in mm, or less.
  virtual double move_to(double x) = 0;
  /// Largest x, up to `end`, to which the gap certainly stays above `level_mm`, which it exceeds
  /// now.
  double certain_until(double level_mm, double end) const;

 protected:
  explicit GapWalk(const PanelMotion& motion) : motion_(motion) {}
  /// Velocities of the corners, seen from the other panel, mm per unit of x. Nodes before flat, -1
  /// and so on, are the mirror images of 0 and so on.
  virtual void find_rates(int node, PolygonCorners& rates) const = 0;
  /// Rates at both ends of the segment that ends at this node, or behind the last one; and an
  /// eighth of the largest second differences around it.
  struct Segment {
    PolygonCorners from, to;
    Eigen::Array<double, 1, 8> error;
  };
  const Segment& segment(int index) const;

  const PanelMotion& motion_;
  double x_ = 0;
  Eigen::Vector3d direction_ = Eigen::Vector3d::UnitZ();
  Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 8> gaps_mm_;  // one per corner

 private:
  const PolygonCorners& rates(int node) const;

  static constexpr int kNone = std::numeric_limits<int>::min();
  // Last segment and the nodes round it: the next segment needs three of the same four.
  mutable std::array<int, 4> nodes_{kNone, kNone, kNone, kNone};
  mutable std::array<PolygonCorners, 4> rates_;
  mutable int segment_index_ = kNone;
  mutable Segment segment_;
};

/// Walk of the gap between a polygon of one panel and a polygon or segment of another.
class PolygonWalk : public GapWalk {
 public:
  PolygonWalk(const PanelMotion& motion, int a, int b, PolygonCorners of_a, PolygonCorners of_b)
      : GapWalk(motion), a_(a), b_(b), of_a_(std::move(of_a)), of_b_(std::move(of_b)) {}

  double move_to(double x) override;
  /// Lower bound of the gap at x, by spheres round both.
  double least_mm(double x) const;
  /// The separation at the place of the last move, in flat coordinates of panel a.
  const Separation& separation() const { return separation_; }

 protected:
  void find_rates(int node, PolygonCorners& rates) const override;

 private:
  const int a_, b_;
  const PolygonCorners of_a_, of_b_;
  Separation separation_;
};

/// Returns an x, up to `end`, at which the gap is at most `touch_mm`, and before which it exceeds
/// half of that. Infinity: it exceeds that half all the way.
double first_touch(GapWalk& walk, double touch_mm, double end);

/// Difference between a least gap and a bound of all gaps: a share of it, and a length.
struct GapSlack {
  double share, mm = 0;
};

/// Returns whether the gap falls below `least_mm` up to `end`. If so, lowers that to a gap that is
/// reached at `at_x`; all others are larger, except for the slack.
bool lower_to_least(GapWalk& walk, const GapSlack& slack, double end, double& least_mm,
                    double& at_x);

}  // namespace misalign::solver
