// Checks a folded sheet from coordinates alone: panels stay flat and rigid and meet at their
// corners, and fold angles are as claimed. It uses no mechanism and no equation of closure.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace misalign::solver {

/// The unit normal of a panel, upwards on the flat sheet.
Eigen::Vector3d normal_of(const Eigen::Matrix3Xd& vertices_mm, const std::array<int, 4>& panel);

/// Angle between the unit normals of the panels on the left and the right of a line with the unit
/// vector `along`: within +-180, valleys positive.
double fold_angle_deg(const Eigen::Vector3d& along, const Eigen::Vector3d& left,
                      const Eigen::Vector3d& right);

/// A fold line a -> b (vertices) between two panels, seen from +z on the flat sheet.
struct FoldLine {
  int a, b;
  int left, right;  ///< panels seen walking from a to b
  int sign;         ///< required sign: +1 valley, -1 mountain
};

class ShapeCheck {
 public:
  /// The largest errors of all shapes seen.
  struct Errors {
    double length_mm = 0;       ///< change of a panel's edge or diagonal from flat to folded
    double planarity_mm = 0;    ///< distance between a panel's two diagonals
    double coincidence_mm = 0;  ///< distance of a panel's corner from its vertex
    double angle_deg = 0;       ///< claimed fold angle less that between the panels' normals
    double beyond_deg = 0;      ///< excess of a fold angle over +-180 degrees
    int wrong_sign = -1;        ///< a fold line folded the wrong way; -1 if there is none
  };

  /// `flat_mm` is 2 x vertices, panels counter-clockwise seen from +z.
  ShapeCheck(const Eigen::Matrix2Xd& flat_mm, std::vector<std::array<int, 4>> panels,
             std::vector<FoldLine> folds);

  /// Checks the next shape of a folding that starts flat. No fold angle may change by 180 degrees
  /// or more between shapes: so angles beyond 180 degrees differ from those of the other sign.
  /// `vertices_mm` is 3 x vertices; `corners_mm` 3 x (4 panels), the corners of each panel in turn;
  /// `claimed_deg` one angle per fold line.
  void see(const Eigen::Matrix3Xd& vertices_mm, const Eigen::Matrix3Xd& corners_mm,
           const std::vector<double>& claimed_deg);

  const Errors& worst() const { return worst_; }

 private:
  void see_panels(const Eigen::Matrix3Xd& vertices_mm, const Eigen::Matrix3Xd& corners_mm);

  Eigen::Matrix3Xd flat_mm_;
  std::vector<std::array<int, 4>> panels_;
  std::vector<FoldLine> folds_;
  std::vector<double> angles_deg_;  // fold angles of the last shape, not limited to 180
  Errors worst_;
};

}  // namespace misalign::solver
