// The study of contact: where the panels of one sheet first meet, how close they come before, how
// thick they may be; and which springs touch.
#pragma once

#include <optional>
#include <vector>

#include "solver/contact/plate_thickness.hpp"
#include "solver/contact/spring_clearance.hpp"

namespace misalign::solver {

/// Default trim of corners, by panel width: 5 mm on the paper's sheet.
inline constexpr double kTrimPart = 1.0 / 16;
/// Clearances are shown at multiples of this pilot angle.
inline constexpr double kClearanceStep_deg = 1;

struct ContactOptions {
  std::optional<double> trim_mm = {};  ///< corner trim; none: kTrimPart of the panel width
  /// Angle of use: plates fold from flat up to this pilot angle; none: up to D.
  std::optional<double> from_deg = {};
  std::optional<SpringBodies> springs = {};  ///< none: springs are not judged
};

struct ContactStudy {
  double deploys_from_deg = 0, end_deg = 0;
  double known_until_deg = 0;  ///< end of the resolved motion
  double used_from_deg = 0;    ///< angle of use
  double reach_deg = 0;        ///< angle of use, or the first contact where that comes before
  double trim_mm = 0;
  std::optional<Contact> first;
  std::vector<double> pilot_deg;
  std::vector<ContactFinder::Clearance> clearances;  ///< one per pilot_deg
  std::optional<PlateThickness> thickness;           ///< none where the sheet deploys from nothing
  std::optional<SpringClearance> springs;            ///< none: not judged; up to reach_deg
};

/// Faults: from_deg lies beyond D; trim_mm leaves nothing of an edge, or end_mm of a spring.
/// Reasons: path_lost.
StudyResult<ContactStudy> contact(const Sheet& sheet, const ContactOptions& options = {});

}  // namespace misalign::solver
