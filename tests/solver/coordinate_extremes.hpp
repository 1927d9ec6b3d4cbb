// The first reversal of a diagonal, and the least rates of change, from vertex coordinates alone
// and steps as short as the path bends: the yardstick for metrics that are found by polynomials in
// fold angles, or by fewer solves.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "tests/solver/vertex_coordinates.hpp"

namespace misalign::solver {

struct CoordinateExtremes {
  bool is_whole = false;                     ///< the path was found up to its last sample
  std::optional<double> reverses_deg;        ///< first reversal of any diagonal
  double least_slope_mm_per_deg = HUGE_VAL;  ///< in the diagonals' directions, from 5 degrees to D
  double least_step_mm_per_deg = HUGE_VAL;   ///< the same from sample to sample
};

/// One sheet. `last_sample` is the last one of its path.
class CoordinateWalk {
 public:
  CoordinateWalk(VertexCoordinates& sheet, const FlatVertices& flat_mm,
                 const std::vector<Diagonal>& diagonals, double sample_deg, int in_order,
                 int last_sample)
      : sheet_(sheet),
        diagonals_(diagonals),
        sample_deg_(sample_deg),
        d_deg_(in_order * sample_deg),
        last_sample_(last_sample),
        direction_(diagonals.size(), 0) {
    for (const Diagonal& diagonal : diagonals) {
      last_lengths_mm_.push_back((flat_mm.col(diagonal.from) - flat_mm.col(diagonal.to)).norm());
    }
  }

  /// The sheet has been put at its first sample.
  CoordinateExtremes run() {
    Point here = look();
    take_sample(here);
    // Back towards flat, where all that could not be seen is which way diagonals set out.
    const std::optional<Point> first = go(here, kFirstPart * sample_deg_);
    if (!first) return found_;
    for (std::size_t d = 0; d < diagonals_.size(); ++d) {
      if (slope(*first, d) < 0) found_.reverses_deg = 0;
    }
    points_ = {*first};
    for (int sample = 1; sample <= last_sample_; ++sample) {
      if (!walk_to(sample * sample_deg_)) return found_;
      if (sample > 1) take_sample(points_.back());
    }
    found_.is_whole = true;
    return found_;
  }

 private:
  static constexpr double kFirstPart = 0.2, kLongest_deg = 0.5, kShortest_deg = 1e-7;

  struct Point {
    double pilot_deg;
    Eigen::Matrix3Xd points_mm;
    std::vector<double> slopes_mm_per_deg;
  };

  double slope(const Point& point, std::size_t d) const {
    return direction_[d] * point.slopes_mm_per_deg[d];
  }

  Point look() {
    Point point{sheet_.reached_deg(), sheet_.points_mm(), {}};
    const Eigen::Matrix3Xd rates = sheet_.rates();
    for (const Diagonal& diagonal : diagonals_) {
      const Eigen::Vector3d apart =
          (point.points_mm.col(diagonal.to) - point.points_mm.col(diagonal.from)).normalized();
      const Eigen::Vector3d rate = rates.col(diagonal.to) - rates.col(diagonal.from);
      point.slopes_mm_per_deg.push_back(apart.dot(rate) * sheet_.unit_mm() * kRadPerDeg);
    }
    return point;
  }

  // In as many steps as it takes.
  std::optional<Point> go(const Point& from, double to_deg) {
    Point here = from;
    double step_deg = to_deg - from.pilot_deg;
    while (here.pilot_deg != to_deg) {
      const bool is_last = std::abs(to_deg - here.pilot_deg) <= std::abs(step_deg);
      const double next_deg = is_last ? to_deg : here.pilot_deg + step_deg;
      if (sheet_.move(here.points_mm, here.pilot_deg, next_deg)) {
        here = look();
      } else if (step_deg *= 0.5; std::abs(step_deg) < kShortest_deg) {
        return std::nullopt;
      }
    }
    return here;
  }

  bool walk_to(double to_deg) {
    while (points_.back().pilot_deg < to_deg) {
      const double from_deg = points_.back().pilot_deg;
      const double next_deg =
          to_deg - from_deg <= step_deg_ * 1.001 ? to_deg : from_deg + step_deg_;
      if (!sheet_.move(points_.back().points_mm, from_deg, next_deg)) {
        step_deg_ *= 0.5;
        if (step_deg_ < kShortest_deg) return false;
        continue;
      }
      points_.push_back(look());
      if (points_.size() > 3) points_.erase(points_.begin());
      see();
      step_deg_ = std::min(1.5 * step_deg_, kLongest_deg);
    }
    return true;
  }

  void take_sample(const Point& point) {
    for (std::size_t d = 0; d < diagonals_.size(); ++d) {
      const Diagonal& diagonal = diagonals_[d];
      const double length_mm =
          (point.points_mm.col(diagonal.from) - point.points_mm.col(diagonal.to)).norm();
      const double step_mm = length_mm - last_lengths_mm_[d];
      if (direction_[d] == 0 && std::abs(step_mm) >= kStepBand_widths * sheet_.unit_mm()) {
        direction_[d] = step_mm > 0 ? 1 : -1;
      }
      if (counts(point.pilot_deg)) {
        found_.least_step_mm_per_deg =
            std::min(found_.least_step_mm_per_deg, std::abs(step_mm) / sample_deg_);
      }
      last_lengths_mm_[d] = length_mm;
    }
  }
  bool counts(double pilot_deg) const {
    return pilot_deg >= kInactiveFrom_deg - 1e-9 && pilot_deg <= d_deg_ + 1e-9;
  }
  void take_slope(const Point& point, std::size_t d) {
    if (!counts(point.pilot_deg)) return;
    found_.least_slope_mm_per_deg = std::min(found_.least_slope_mm_per_deg, slope(point, d));
  }

  // The newest point, and the way to it.
  void see() {
    const Point& here = points_.back();
    for (std::size_t d = 0; d < diagonals_.size(); ++d) {
      take_slope(here, d);
      if (direction_[d] == 0 || points_.size() < 2) continue;
      const Point& before = points_[points_.size() - 2];
      if (slope(before, d) >= 0 && slope(here, d) < 0) turn_between(before, here, d);
      if (points_.size() == 3) see_dip(d);
    }
  }

  void turn_between(Point low, Point high, std::size_t d) {
    if (found_.reverses_deg && *found_.reverses_deg <= low.pilot_deg) return;
    for (int k = 0; k < 60 && high.pilot_deg - low.pilot_deg > 2e-9; ++k) {
      // By halves and by the chord in turn.
      const double chord = slope(low, d) / (slope(low, d) - slope(high, d));
      const double share = k % 3 == 2 ? 0.5 : std::clamp(chord, 1e-3, 1 - 1e-3);
      const double width_deg = high.pilot_deg - low.pilot_deg;
      const auto middle = go(share < 0.5 ? low : high, low.pilot_deg + share * width_deg);
      if (!middle) break;
      (slope(*middle, d) < 0 ? high : low) = *middle;
    }
    const double turn_deg = 0.5 * (low.pilot_deg + high.pilot_deg);
    found_.reverses_deg = std::min(found_.reverses_deg.value_or(turn_deg), turn_deg);
  }

  // A least rate at or next to the middle one of three points.
  void see_dip(std::size_t d) {
    Point low = points_[0], middle = points_[1], high = points_[2];
    if (slope(middle, d) > slope(low, d) || slope(middle, d) > slope(high, d)) return;
    // What a parabola's least may lie below its least point by, and as much again.
    const double room = std::max(slope(low, d), slope(high, d)) - slope(middle, d);
    const bool may_turn = slope(middle, d) >= 0 && slope(middle, d) < room;
    const bool may_be_least =
        counts(middle.pilot_deg) && slope(middle, d) - room < found_.least_slope_mm_per_deg;
    if (!may_turn && !may_be_least) return;
    const Point start = low;
    for (int k = 0; k < 40 && high.pilot_deg - low.pilot_deg > 1e-5; ++k) {
      const bool in_left = middle.pilot_deg - low.pilot_deg > high.pilot_deg - middle.pilot_deg;
      const double next_deg =
          middle.pilot_deg + 0.382 * ((in_left ? low : high).pilot_deg - middle.pilot_deg);
      const auto next = go(middle, next_deg);
      if (!next) return;
      take_slope(*next, d);
      if (slope(*next, d) < slope(middle, d)) {
        (in_left ? high : low) = middle;
        middle = *next;
      } else {
        (in_left ? low : high) = *next;
      }
    }
    if (slope(start, d) >= 0 && slope(middle, d) < 0) turn_between(start, middle, d);
  }

  VertexCoordinates& sheet_;
  const std::vector<Diagonal>& diagonals_;
  const double sample_deg_, d_deg_;
  const int last_sample_;
  std::vector<int> direction_;
  std::vector<double> last_lengths_mm_;  // at the last sample
  std::vector<Point> points_;            // the last three
  double step_deg_ = 0.1;
  CoordinateExtremes found_;
};

/// Of a sheet with D of so many samples whose path ends here.
inline CoordinateExtremes coordinate_extremes(const PerforatedSheet& base,
                                              const Mechanism& mechanism,
                                              const FlatVertices& flat_mm, double sample_deg,
                                              int in_order, double end_deg) {
  SheetGeometry<double> geometry;
  place(mechanism, flat_mm, geometry);
  const auto near =
      base_state(mechanism, base.folding, base.sheet.vertices_mm, half_angle_of_deg(sample_deg));
  const FoldedShape shape(base.sheet, base.holes, mechanism);
  VertexCoordinates sheet(base, flat_mm, shape.vertices_mm(geometry, near), sample_deg);
  const int last_sample = static_cast<int>(std::floor(end_deg / sample_deg + 1e-9));
  return CoordinateWalk(sheet, flat_mm, mechanism.diagonals, sample_deg, in_order, last_sample)
      .run();
}

}  // namespace misalign::solver
