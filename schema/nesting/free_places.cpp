#include "schema/nesting/free_places.hpp"

#include <algorithm>

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kRounding_mm = 1e-9;

}  // namespace

PlaneBox PlaneBox::round(const std::vector<PlanePoints>& pieces) {
  PlaneBox box;
  for (const PlanePoints& piece : pieces) {
    for (const Vector2d& point : piece) {
      box.least = box.least.cwiseMin(point);
      box.most = box.most.cwiseMax(point);
    }
  }
  return box;
}

FreePlaces::FreePlaces(const std::vector<PlanePoints>& shape, const PlaneBox& box,
                       const std::vector<PlanePoints>& on_bed, const Vector2d& size_mm,
                       double gap_mm)
    : least_(-box.least), most_(size_mm - box.most) {
  const double top_mm = on_bed.empty() ? 0 : PlaneBox::round(on_bed).most.y() + gap_mm;
  most_.y() = std::min(most_.y(), top_mm - box.least.y());  // free from there on
  if (!has_room()) return;
  for (const PlanePoints& fixed : on_bed) {
    for (const PlanePoints& moving : shape) {
      Forbidden forbidden(fixed, moving, gap_mm);
      const bool in_reach = (forbidden.most_mm() - least_).minCoeff() > 0 &&
                            (most_ - forbidden.least_mm()).minCoeff() > 0;
      if (in_reach) forbidden_.push_back(std::move(forbidden));
    }
  }
}

bool FreePlaces::has_room() const { return (most_ - least_).minCoeff() >= -kRounding_mm; }

std::optional<Vector2d> FreePlaces::lowest(double most_y_mm) const {
  constexpr double kStep_mm = 2;
  constexpr int kSlides = 4;
  if (!has_room()) return std::nullopt;
  const double end = std::min(std::max(most_.y(), least_.y()), most_y_mm);
  for (double y = least_.y(); y <= end;
       y = y < end ? std::min(y + kStep_mm, end) : end + kStep_mm) {
    const auto x = first_free(taken(1, y), least_.x(), most_.x());
    if (!x) continue;
    Vector2d at(*x, y);
    for (int k = 0; k < kSlides; ++k) slide(at, 1 - k % 2);
    return at;
  }
  return std::nullopt;
}

std::vector<OpenInterval> FreePlaces::taken(int axis, double value) const {
  std::vector<OpenInterval> intervals;
  for (const Forbidden& forbidden : forbidden_) {
    if (const auto interval = forbidden.at(axis, value)) intervals.push_back(*interval);
  }
  return intervals;
}

// Lowers a coordinate to the first interval in its way. A place on the bound of one whose side is
// almost along the way is rounded to within it, and stays.
void FreePlaces::slide(Vector2d& at, int coordinate) const {
  double stop = least_(coordinate);
  for (const OpenInterval& interval : taken(1 - coordinate, at(1 - coordinate))) {
    if (interval.low < at(coordinate)) stop = std::max(stop, interval.high);
  }
  at(coordinate) = std::min(at(coordinate), stop);
}

}  // namespace misalign::schema
