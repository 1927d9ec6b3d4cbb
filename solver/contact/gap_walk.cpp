#include "solver/contact/gap_walk.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

// The first s > 0 at which f + b s + a s^2 is zero, f > 0; infinity if there is none.
double first_root(double f, double b, double a) {
  const double discriminant = b * b - 4 * a * f;
  const double below = -b + std::sqrt(std::max(discriminant, 0.0));
  return discriminant >= 0 && below > 0 ? 2 * f / below : std::numeric_limits<double>::infinity();
}

}  // namespace

const PolygonCorners& GapWalk::rates(int node) const {
  assert(node < motion_.nodes());
  const auto slot = static_cast<std::size_t>(node & 3);
  if (nodes_[slot] != node) find_rates(node, rates_[slot]);
  nodes_[slot] = node;
  return rates_[slot];
}

const GapWalk::Segment& GapWalk::segment(int index) const {
  if (index == segment_index_) return segment_;
  assert(index >= 0 && index <= motion_.nodes());
  segment_index_ = index;
  auto& [from, to, error] = segment_;
  const int last = motion_.nodes() - 1;
  const bool is_behind_all = index > last;
  from = rates(index - 1);
  const PolygonCorners& before = rates(index - 2);
  const PolygonCorners& beyond = rates(is_behind_all ? index - 3 : std::min(index + 1, last));
  to = is_behind_all ? PolygonCorners(2 * from - before) : rates(index);
  for (Index k = 0; k < from.cols(); ++k) {
    double curved = 0;
    if (is_behind_all) {  // half a step beyond two nodes that the line goes through: three eighths
      curved = 3 * (from.col(k) - 2 * before.col(k) + beyond.col(k)).norm();
    } else {
      curved = (to.col(k) - 2 * from.col(k) + before.col(k)).norm();
      if (index < last) {
        curved = std::max(curved, (beyond.col(k) - 2 * to.col(k) + from.col(k)).norm());
      }
    }
    error(k) = curved / 8;
  }
  return segment_;
}

double GapWalk::certain_until(double level_mm, double end) const {
  assert(x_ >= 0 && x_ <= end);
  assert(gaps_mm_.minCoeff() > level_mm && "the gap is open where it was last looked at");
  const double step = motion_.step();
  const double place = x_ / step + 0.5;
  int index = std::min(static_cast<int>(place), motion_.nodes());
  double from = place - index;
  auto gaps_mm = gaps_mm_;
  for (;; ++index, from = 0) {
    const Segment& rates = segment(index);
    double until = 1;
    for (Index k = 0; k < gaps_mm.cols(); ++k) {
      const double error_mm = kRateSafety * rates.error(k) + kRateError * motion_.panel_width_mm();
      const double rate_mm = direction_.dot(rates.from.col(k));
      const double change_mm = direction_.dot(rates.to.col(k)) - rate_mm;
      const double b = step * (rate_mm - error_mm + change_mm * from);
      const double a = step * change_mm / 2;
      until = std::min(until, from + first_root(gaps_mm(k) - level_mm, b, a));
      gaps_mm(k) += (1 - from) * (b + (1 - from) * a);
    }
    const double reached = (index - 0.5 + until) * step;
    if (reached >= end) return end;
    if (until < 1 || index == motion_.nodes()) return std::max(reached, x_);
  }
}

double PolygonWalk::move_to(double x) {
  x_ = x;
  const PanelMotion::Pose a = motion_.pose(x, a_), b = motion_.pose(x, b_);
  PolygonCorners seen = of_b_;
  for (Index k = 0; k < seen.cols(); ++k) seen.col(k) = seen_from(a, b, of_b_.col(k));
  separation_ = separation_of(of_a_, seen);
  direction_ = separation_.direction;
  gaps_mm_ = (direction_.transpose() * seen).array() - (direction_.transpose() * of_a_).maxCoeff();
  return gaps_mm_.minCoeff();
}

double PolygonWalk::least_mm(double x) const {
  constexpr double kRounding_mm = 1e-6;
  const Vector3d at_a = of_a_.rowwise().mean(), at_b = of_b_.rowwise().mean();
  const auto radius_mm = [](const PolygonCorners& polygon, const Vector3d& centre) {
    return std::sqrt((polygon.colwise() - centre).colwise().squaredNorm().maxCoeff());
  };
  const Vector3d seen = seen_from(motion_.pose(x, a_), motion_.pose(x, b_), at_b);
  return (seen - at_a).norm() - radius_mm(of_a_, at_a) - radius_mm(of_b_, at_b) - kRounding_mm;
}

void PolygonWalk::find_rates(int node, PolygonCorners& rates) const {
  const int like = node < 0 ? -1 - node : node;
  const PanelMotion::MovingPose &a = motion_.at_node(like, a_), &b = motion_.at_node(like, b_);
  rates.resize(3, of_b_.cols());
  for (Index k = 0; k < rates.cols(); ++k) rates.col(k) = rate_seen_from(a, b, of_b_.col(k));
  if (node < 0) rates.topRows<2>() *= -1;  // the mirror image, the other way
}

double first_touch(GapWalk& walk, double touch_mm, double end) {
  assert(touch_mm > 0 && end >= 0);
  for (double x = 0;; x = walk.certain_until(touch_mm / 2, end)) {
    if (walk.move_to(x) <= touch_mm) return x;
    if (x >= end) return std::numeric_limits<double>::infinity();
  }
}

bool lower_to_least(GapWalk& walk, const GapSlack& slack, double end, double& least_mm,
                    double& at_x) {
  assert(slack.share >= 0 && slack.share < 1 && slack.share + slack.mm > 0 && end >= 0);
  assert(least_mm > 0);
  bool is_less = false;
  for (double x = 0;; x = walk.certain_until((1 - slack.share) * least_mm - slack.mm, end)) {
    const double gap_mm = walk.move_to(x);
    if (gap_mm < least_mm) {
      least_mm = gap_mm;
      at_x = x;
      is_less = true;
    }
    if (x >= end || gap_mm <= slack.mm) return is_less;
  }
}

}  // namespace misalign::solver
