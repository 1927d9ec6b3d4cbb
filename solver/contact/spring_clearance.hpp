// Clearance of springs, as round bodies, from each other and from panels on a folding way.
//
// A spring is a capsule: all points within half its diameter of its axis, the line between its
// ends. Two springs that end at one vertex, and the panels there, always meet at that vertex: so
// the ends of each axis, the hooks, are left out. A panel is all points within half its thickness
// of its mid-plane, trimmed as in plate_thickness.hpp. Rubber plates are not judged.
#pragma once

#include <optional>
#include <vector>

#include "solver/contact/spring_walk.hpp"
#include "solver/sheet/sheet_filling.hpp"
#include "solver/studies/study_result.hpp"

namespace misalign::solver {

/// Bodies this close touch. Bodies that meet at any angle come this close at one that is looked at:
/// GapWalk's bounds leave out no more.
inline constexpr double kSpringTouch_mm = 0.02;

/// Two bodies where they come closest.
struct SpringMeeting {
  int spring;            ///< its diagonal
  int other = -1;        ///< diagonal of the other spring; -1: the other body is a panel
  int panel = -1;        ///< -1: the other body is a spring
  double apart_mm = 0;   ///< least distance of the axes, or of axis and mid-plane
  double clear_mm = 0;   ///< the same of the bodies; negative where they overlap
  double pilot_deg = 0;  ///< angle at which it is reached

  bool touches() const { return clear_mm < kSpringTouch_mm; }
};

/// The closest pair, and those that touch.
struct SpringMeetings {
  std::optional<SpringMeeting> closest;
  std::vector<SpringMeeting> touching;
};

struct SpringClearance {
  /// Distances of axes at one angle, mm; infinity: there is no such pair.
  struct Apart {
    double least_hole_mm, largest_hole_mm;  ///< two springs of one hole; largest 0: none
    double springs_mm;                      ///< least, of springs of different holes
    double panels_mm;                       ///< least, of springs from mid-planes
  };
  SpringBodies bodies;
  std::vector<Diagonal> diagonals;  ///< the sheet's, which meetings name by number
  SpringMeetings springs, panels;
  std::vector<Apart> apart;  ///< one for each angle of the study
};

/// The closest of springs with each other and with panels; null where nothing is close.
const SpringMeeting* closest_meeting(const SpringClearance& clearance);

/// Diagonals that have a spring, ascending; none of plates.
std::vector<int> sprung_diagonals(const Filling& filling);

/// Axes of these diagonals' springs with ends where the mechanism has them.
std::vector<SpringAxis> spring_axes(const Mechanism& mechanism, const Panels& panels,
                                    const FoldingWay& way, const SpringBodies& bodies);

/// Fault (end_mm, diameter_mm): the ends that are left out leave nothing of the shortest spring.
std::optional<OptionFault> nothing_left_of_springs(const Sheet& sheet, const SpringBodies& bodies,
                                                   const FoldingWay& way);

/// Springs that touch between flat and `end` (x, where the motion is resolved).
SpringMeetings springs_that_meet(const PanelMotion& motion, const std::vector<SpringAxis>& axes,
                                 const SpringBodies& bodies, double end);

/// Clearance between flat and `end`, distances at these angles. `outlines` are the trimmed panels.
/// Fault: end_mm leaves nothing of a spring.
StudyResult<SpringClearance> spring_clearance(const Sheet& sheet, const PanelMotion& motion,
                                              const std::vector<PolygonCorners>& outlines,
                                              const SpringBodies& bodies, double end,
                                              const std::vector<double>& pilot_deg);

/// Pairs of diagonals whose springs touch between flat and an angle, if every diagonal has one.
/// Fault: from_deg lies beyond D; end_mm leaves nothing of a spring. Reason: path_lost.
StudyResult<std::vector<std::pair<int, int>>> touching_springs(const Sheet& sheet,
                                                               const SpringBodies& bodies,
                                                               double from_deg);

}  // namespace misalign::solver
