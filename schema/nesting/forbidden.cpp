#include "schema/nesting/forbidden.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kTouch_mm = 1e-9, kSameWay_rad = 1e-7;

double support(const PlanePoints& points, const Vector2d& direction) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector2d& point : points) most = std::max(most, direction.dot(point));
  return most;
}

struct Direction {
  double rad;
  Vector2d unit;
};

// A sixteenth of a turn apart: a polygon round an arc exceeds it by a fiftieth at most.
std::vector<Direction> sixteenths() {
  constexpr int kCount = 16;
  std::vector<Direction> all;
  for (int k = 0; k < kCount; ++k) {
    const double rad = std::numbers::pi * (2.0 * k / kCount - 1);
    all.push_back({rad, {std::cos(rad), std::sin(rad)}});
  }
  return all;
}

// Directions, ascending, of the polygon's edges' normals: those of `fixed`, the opposite ones of
// `moving`, and sixteenths of a turn for the arcs between them.
std::vector<Direction> directions(const PlanePoints& fixed, const PlanePoints& moving) {
  static const std::vector<Direction> kArcs = sixteenths();
  std::vector<Direction> all = kArcs;
  all.reserve(all.size() + fixed.size() + moving.size());
  const auto add = [&](const PlanePoints& points, double sense) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vector2d along = sense * (points[(k + 1) % points.size()] - points[k]);
      const double length = along.norm();
      if (length <= kTouch_mm) continue;
      all.push_back({std::atan2(-along.x(), along.y()), Vector2d(along.y(), -along.x()) / length});
    }
  };
  add(fixed, 1);
  add(moving, -1);
  std::ranges::sort(all, {}, &Direction::rad);
  const auto is_same = [](const Direction& first, const Direction& second) {
    return second.rad - first.rad < kSameWay_rad;
  };
  all.erase(std::unique(all.begin(), all.end(), is_same), all.end());
  if (all.front().rad + 2 * std::numbers::pi - all.back().rad < kSameWay_rad) all.pop_back();
  return all;
}

}  // namespace

Forbidden::Forbidden(const PlanePoints& fixed, const PlanePoints& moving, double gap_mm) {
  const std::vector<Direction> ways = directions(fixed, moving);
  std::vector<double> bounds_mm(ways.size());
  for (std::size_t k = 0; k < ways.size(); ++k) {
    bounds_mm[k] = support(fixed, ways[k].unit) + support(moving, -ways[k].unit) + gap_mm;
  }
  corners_.reserve(ways.size());
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const std::size_t next = (k + 1) % ways.size();
    const Vector2d &first = ways[k].unit, &second = ways[next].unit;
    const double sine = cross(first, second);
    corners_.emplace_back((bounds_mm[k] * second.y() - bounds_mm[next] * first.y()) / sine,
                          (bounds_mm[next] * first.x() - bounds_mm[k] * second.x()) / sine);
    least_mm_ = least_mm_.cwiseMin(corners_.back());
    most_mm_ = most_mm_.cwiseMax(corners_.back());
  }
}

std::optional<OpenInterval> Forbidden::at(int axis, double value) const {
  if (value <= least_mm_(axis) + kTouch_mm || value >= most_mm_(axis) - kTouch_mm) return {};
  OpenInterval interval{std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const Vector2d &p = corners_[k], &q = corners_[(k + 1) % corners_.size()];
    if ((p(axis) > value) == (q(axis) > value)) continue;
    const double share = (value - p(axis)) / (q(axis) - p(axis)),
                 crossing = p(1 - axis) + share * (q(1 - axis) - p(1 - axis));
    interval.low = std::min(interval.low, crossing);
    interval.high = std::max(interval.high, crossing);
  }
  return interval;
}

std::optional<double> first_free(std::vector<OpenInterval> taken, double from, double to) {
  std::ranges::sort(taken, {}, &OpenInterval::low);
  double at = from;
  for (const OpenInterval& interval : taken) {
    if (interval.low >= at) break;
    at = std::max(at, interval.high);
  }
  if (at > to + kTouch_mm) return std::nullopt;
  return at;
}

}  // namespace misalign::schema
