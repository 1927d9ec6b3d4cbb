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

Vector2d unit(double rad) { return {std::cos(rad), std::sin(rad)}; }

// Directions, ascending, of the polygon's edges' normals: those of `fixed`, the opposite ones of
// `moving`, and others between them that are at most a sixteenth of a turn apart.
std::vector<double> directions(const PlanePoints& fixed, const PlanePoints& moving) {
  constexpr int kLeast = 16;
  constexpr double kTurn = 2 * std::numbers::pi;
  std::vector<double> rads;
  const auto add = [&](const PlanePoints& points, double sense) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vector2d along = sense * (points[(k + 1) % points.size()] - points[k]);
      if (along.norm() > kTouch_mm) rads.push_back(std::atan2(-along.x(), along.y()));
    }
  };
  add(fixed, 1);
  add(moving, -1);
  std::ranges::sort(rads);
  std::vector<double> all;
  for (std::size_t k = 0; k < rads.size(); ++k) {
    const double next = k + 1 < rads.size() ? rads[k + 1] : rads[0] + kTurn, apart = next - rads[k];
    if (apart < kSameWay_rad) continue;
    const int steps = std::max(1, static_cast<int>(std::ceil(apart * kLeast / kTurn - kSameWay_rad)));
    for (int step = 0; step < steps; ++step) all.push_back(rads[k] + apart * step / steps);
  }
  return all;
}

}  // namespace

Forbidden::Forbidden(const PlanePoints& fixed, const PlanePoints& moving, double gap_mm) {
  const std::vector<double> rads = directions(fixed, moving);
  std::vector<double> bounds_mm;
  for (const double rad : rads) {
    bounds_mm.push_back(support(fixed, unit(rad)) + support(moving, -unit(rad)) + gap_mm);
  }
  for (std::size_t k = 0; k < rads.size(); ++k) {
    const std::size_t next = (k + 1) % rads.size();
    const Vector2d first = unit(rads[k]), second = unit(rads[next]);
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

void Forbidden::move(const Vector2d& by_mm) {
  for (Vector2d& corner : corners_) corner += by_mm;
  least_mm_ += by_mm;
  most_mm_ += by_mm;
}

std::optional<double> first_free(std::vector<OpenInterval> taken, double from, double to) {
  std::ranges::sort(taken, {}, &OpenInterval::low);
  double at = from;
  for (const OpenInterval& interval : taken) {
    if (interval.low >= at - kTouch_mm && interval.low >= at) break;
    at = std::max(at, interval.high);
  }
  if (at > to + kTouch_mm) return std::nullopt;
  return at;
}

}  // namespace misalign::schema
