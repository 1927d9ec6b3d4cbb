#include "solver/contact/panel_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>

#include "solver/linear/held_correction.hpp"
#include "solver/model/base_path.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Newton squares the error: after a correction of 1e-7 rad only rounding is left.
constexpr int kMostCorrections = 4;
constexpr double kLastCorrection_rad = 1e-7;

constexpr Index kPerPose = 12;  // the rotation's columns, then the shift

// The mirror image lies on the other side of flat: z is odd, and so is what z adds to x and y.
std::vector<SmoothTable::Parity> parities_of(Index panels) {
  const auto even = SmoothTable::Parity::even, odd = SmoothTable::Parity::odd;
  std::vector<SmoothTable::Parity> parities;
  for (Index panel = 0; panel < panels; ++panel) {
    parities.insert(parities.end(),
                    {even, even, odd, even, even, odd, odd, odd, even, even, even, odd});
  }
  return parities;
}

Vector3d as_vector(const Vec3<double>& v) { return {v.x, v.y, v.z}; }

PanelMotion::Pose pose_of(const Pose<double>& pose, double width_mm) {
  PanelMotion::Pose seen;
  seen.rotation << as_vector(pose.rotation.cx), as_vector(pose.rotation.cy),
      as_vector(pose.rotation.cz);
  seen.shift_mm = width_mm * as_vector(pose.translation);
  return seen;
}

// The last row of differences of a row of values.
Eigen::MatrixXd eighth_differences(Eigen::MatrixXd values) {
  assert(values.cols() >= SmoothTable::kPoints);
  for (int order = 0; order < SmoothTable::kPoints; ++order) {
    const Index last = values.cols() - 1;
    values = (values.rightCols(last) - values.leftCols(last)).eval();
  }
  return values;
}

}  // namespace

PanelMotion::PanelMotion(const Model& model, const FoldingWay& way, const Panels& panels)
    : model_(model),
      way_(way),
      panels_(panels),
      step_(2 * way.x_of_station(0)),
      state_(flat_state<double>(model.mechanism())),
      lu_(model.elimination()),
      residual_(static_cast<std::size_t>(model.mechanism().unknowns)),
      work_(residual_),
      turn_(residual_) {
  assert(panels.corners.size() == panels.facets.size());
  assert(panels.folds.size() == model.mechanism().creases.size());
  for (const std::array<int, 4>& corners : panels.corners) {
    PolygonCorners polygon(3, 4);
    for (int k = 0; k < 4; ++k) {
      polygon.col(k) << way.from_a1_mm().col(corners[static_cast<std::size_t>(k)]), 0;
    }
    corners_mm_.push_back(polygon);
  }
  cached_.assign(corners_mm_.size(), {-1, {}});
  place_at_stations();
}

void PanelMotion::place_at_stations() {
  const Index count = panels();
  Eigen::MatrixXd values(kPerPose * count, nodes());
  FoldedShape::Points<double> points;
  std::vector<FoldedShape::Twist<double>> twists;
  for (Index k = 0; k < values.cols(); ++k) {
    const WayStation& station = way_.stations()[static_cast<std::size_t>(k)];
    model_.shape().place(way_.geometry(), station.state, points);
    model_.shape().move(way_.geometry(), points, station.rates.data(), twists);
    for (Index panel = 0; panel < count; ++panel) {
      const auto facet = static_cast<std::size_t>(panels_.facets[static_cast<std::size_t>(panel)]);
      MovingPose pose{pose_of(points.facets[facet], panel_width_mm()), {}, {}};
      const Vector3d spin = as_vector(twists[facet].spin), drift = as_vector(twists[facet].drift);
      for (int axis = 0; axis < 3; ++axis) {
        pose.rotation_rate.col(axis) = spin.cross(pose.rotation.col(axis));
      }
      pose.shift_rate_mm = spin.cross(pose.shift_mm) + panel_width_mm() * drift;
      values.col(k).segment<9>(kPerPose * panel) = pose.rotation.reshaped();
      values.col(k).segment<3>(kPerPose * panel + 9) = pose.shift_mm;
      nodes_.push_back(pose);
    }
  }
  poses_.emplace_back(way_.table(values, parities_of(count)));
  smooth_until_ = smooth_part(values);
  resolved_until_ = resolved_part();
  assert(smooth_until_ >= 0 && smooth_until_ <= way_.end());
  assert(resolved_until_ > 0 && resolved_until_ <= way_.end());
}

double PanelMotion::smooth_part(const Eigen::MatrixXd& poses) const {
  const Eigen::MatrixXd differences = eighth_differences(poses);
  Index smooth = 0;
  for (; smooth < differences.cols(); ++smooth) {
    double worst_mm = 0;
    for (int panel = 0; panel < panels(); ++panel) {
      const auto of_panel = differences.col(smooth).segment(kPerPose * panel, kPerPose);
      const double far_mm = corners_mm(panel).cwiseAbs().maxCoeff();
      worst_mm = std::max(worst_mm, far_mm * of_panel.head<9>().cwiseAbs().maxCoeff() +
                                        of_panel.tail<3>().cwiseAbs().maxCoeff());
    }
    if (!(worst_mm < kSmooth_mm)) break;
  }
  if (smooth == differences.cols()) return way_.end();
  return smooth == 0 ? 0 : way_.x_of_station(static_cast<std::size_t>(smooth) + 2);
}

double PanelMotion::resolved_part() const {
  const auto rate = [&](int node, int panel, int corner) -> Vector3d {
    const MovingPose& pose = at_node(node, panel);
    return pose.rotation_rate * corners_mm(panel).col(corner) + pose.shift_rate_mm;
  };
  for (int node = 1; node + 1 < nodes(); ++node) {
    for (int panel = 0; panel < panels(); ++panel) {
      for (int corner = 0; corner < 4; ++corner) {
        const Vector3d before = rate(node - 1, panel, corner), middle = rate(node, panel, corner),
                       after = rate(node + 1, panel, corner);
        const double largest =
            std::max({before.norm(), middle.norm(), after.norm(), panel_width_mm() / 10});
        if (!((after - 2 * middle + before).norm() <= kResolved * largest)) {
          return way_.x_of_station(static_cast<std::size_t>(std::max(node - 2, 0)));
        }
      }
    }
  }
  return way_.end();
}

PanelMotion::Pose PanelMotion::pose(double x, int panel) const {
  assert(x >= 0 && panel >= 0 && panel < panels());
  if (x > smooth_until_) {
    solve(x);
    return solved_[static_cast<std::size_t>(panel)];
  }
  CachedPose& cached = cached_[static_cast<std::size_t>(panel)];
  if (x != cached.x) {
    poses_.front().find(x, kPerPose * panel, kPerPose, values_, slopes_);
    cached = {x, {Eigen::Map<const Matrix3d>(values_.data()), values_.tail<3>()}};
  }
  return cached.pose;
}

double PanelMotion::crease_rad(double x, int crease) const {
  assert(x >= 0 && crease >= 0 && crease < std::ssize(panels_.folds));
  if (x > smooth_until_) {
    solve(x);
    return angle_rad(state_.creases[static_cast<std::size_t>(crease)]);
  }
  if (x != creases_at_) way_.find_creases(x, creases_rad_, slopes_);
  creases_at_ = x;
  return creases_rad_(crease);
}

void PanelMotion::place(const FoldState<double>& state, std::vector<Pose>& poses) const {
  FoldedShape::Points<double> points;
  model_.shape().place(way_.geometry(), state, points);
  poses.clear();
  for (const int facet : panels_.facets) {
    poses.push_back(pose_of(points.facets[static_cast<std::size_t>(facet)], panel_width_mm()));
  }
}

void PanelMotion::solve(double x) const {
  if (x == solved_at_) return;
  solved_at_ = x;
  if (model_.is_overconstrained()) {
    BasePath(model_.mechanism(), model_.base())
        .find_state(half_angle_of_deg(way_.pilot_deg(x)), state_);
    return place(state_, solved_);
  }
  way_.find_state(x, state_);
  const FoldState<double> looked_up = state_;
  state_.creases[static_cast<std::size_t>(model_.mechanism().pilot)] =
      half_angle_of_deg(way_.pilot_deg(x));
  double correction_rad = 1;
  for (int k = 0; k < kMostCorrections && correction_rad > kLastCorrection_rad; ++k) {
    correct_held(model_.mechanism(), way_.geometry(), true, lu_, residual_, work_, turn_, state_);
    correction_rad = 0;
    for (const double turn : turn_) correction_rad = std::max(correction_rad, std::abs(turn));
  }
  // The pilot cannot be held next to its fold limit.
  if (!(correction_rad <= kLastCorrection_rad)) state_ = looked_up;
  place(state_, solved_);
}

double PanelMotion::crease_rate(int node, int crease) const {
  assert(node >= 0 && node < nodes() && crease >= 0 && crease < std::ssize(panels_.folds));
  const int column = model_.mechanism().creases[static_cast<std::size_t>(crease)].column;
  return way_.stations()[static_cast<std::size_t>(node)].rates[static_cast<std::size_t>(column)];
}

std::optional<PanelMotion> resolved_motion(const Sheet& sheet) {
  std::optional<PanelMotion> motion;
  for (int stations = kFewestMotionStations; stations <= kMostMotionStations; stations *= 2) {
    motion.reset();
    const FoldingWay* const way = sheet.way(stations);
    if (!way) break;
    motion.emplace(sheet.model(), *way, sheet.panels());
    if (motion->resolved_until() >= way->end()) break;
  }
  return motion;
}

}  // namespace misalign::solver
