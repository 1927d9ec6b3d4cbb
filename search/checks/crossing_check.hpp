// Finds panels that pass through each other, which the paper assumes not to happen.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace misalign::search {

/// Relative tolerance that tells touching from crossing: panels are shrunk by this part of their
/// size, and each must reach through the other's plane by as much.
inline constexpr double kTouch = 1e-6;

/// One sheet of rigid panels without thickness. Panels with a common vertex are not compared: they
/// meet there in every state.
class CrossingCheck {
 public:
  /// Panels are convex quadrilaterals of the flat vertices (2 x vertices, mm).
  CrossingCheck(const Eigen::Matrix2Xd& flat_mm, const std::vector<std::array<int, 4>>& panels);
  ~CrossingCheck();
  CrossingCheck(const CrossingCheck&) = delete;
  CrossingCheck& operator=(const CrossingCheck&) = delete;

  /// Returns two panels that cross in this state, if there are any. Corners are 3 x (4 panels) in
  /// mm, in the panels' order.
  std::optional<std::pair<int, int>> crossing(const Eigen::Matrix3Xd& corners_mm);

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace misalign::search
