// Where panels meet, and how thick they may be, as JSON and as words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/campaign/pattern_file.hpp"
#include "solver/design/plate_thickness.hpp"

namespace misalign::schema {

/// Corners are trimmed by this part of the panel width where nothing else is said: 5 mm on the
/// paper's sheet.
inline constexpr double kTrimPart = 1.0 / 16;
/// Clearances are shown at multiples of this pilot angle.
inline constexpr double kClearanceStep_deg = 1;

struct ContactStudy {
  double deploys_from_deg = 0, end_deg = 0;
  double known_until_deg = 0;  ///< as far as the motion is resolved
  double reach_deg = 0;        ///< D, or the first contact where that comes before
  double trim_mm = 0;
  std::optional<solver::Contact> first;
  std::vector<double> pilot_deg;
  std::vector<solver::Clearance> clearances;        ///< at these
  std::optional<solver::PlateThickness> thickness;  ///< none where the sheet deploys from nothing
};

/// "panels [2,3] and [4,3]", with what they have in common.
std::string panels_text(const Pattern& base, const solver::Panels& panels,
                        const solver::PanelPair& pair);

/// {"pilot_deg", "kind", "panels", "joint", "on_panels_mm"}: where on either panel, on the flat
/// sheet.
Json contact_json(const Pattern& base, const solver::Panels& panels,
                  const solver::Contact& contact);

/// All of it; clearances as arrays.
Json contact_study_json(const Pattern& base, const solver::Panels& panels,
                        const ContactStudy& study);

}  // namespace misalign::schema
