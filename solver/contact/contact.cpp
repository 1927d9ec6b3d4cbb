#include "solver/contact/contact.hpp"

#include <algorithm>
#include <cassert>

#include "solver/studies/angle_of_use.hpp"

namespace misalign::solver {

StudyResult<ContactStudy> contact(const Sheet& sheet, const ContactOptions& options) {
  const double largest_mm = largest_trim_mm(sheet.panels(), sheet.vertices_mm());
  if (options.from_deg) {
    if (auto fault = beyond_d(sheet, *options.from_deg)) return *fault;
  }
  ContactStudy study;
  study.trim_mm = options.trim_mm.value_or(kTrimPart * sheet.mechanism().panel_width_mm);
  if (!(study.trim_mm < largest_mm)) {
    return OptionFault{"trim_mm", shown("%g", study.trim_mm),
                       "leaves nothing of an edge of " + sheet.name() + " (that takes " +
                           shown("%.4g", largest_mm) + " mm)",
                       "trim less"};
  }
  const std::optional<PanelMotion> motion = resolved_motion(sheet);
  if (!motion) return NoResult::path_lost;
  const FoldingWay& way = motion->way();
  const double known = motion->resolved_until();
  assert(known > 0 && known <= way.end());
  study.deploys_from_deg = sheet.deploys_from_deg();
  study.end_deg = way.end_deg();
  study.known_until_deg = way.pilot_deg(known);
  const ContactFinder finder(sheet.panels(), *motion);
  study.first = finder.first(known);
  assert(!study.first || study.first->x <= known);
  const double last_deg = study.first ? study.first->pilot_deg : study.known_until_deg;
  for (double pilot_deg = 0; pilot_deg <= last_deg; pilot_deg += kClearanceStep_deg) {
    study.pilot_deg.push_back(pilot_deg);
    study.clearances.push_back(finder.clearance(way.x_of(pilot_deg)));
  }
  study.used_from_deg = options.from_deg.value_or(study.deploys_from_deg);
  study.reach_deg = std::min(study.used_from_deg, last_deg);
  if (study.reach_deg > 0) {
    study.thickness =
        largest_thickness(sheet.panels(), *motion, way.x_of(study.reach_deg), study.trim_mm);
  }
  if (options.springs) {
    const auto outlines = trimmed_panels(sheet.panels(), way.from_a1_mm(), study.trim_mm);
    auto springs = spring_clearance(sheet, *motion, outlines, *options.springs,
                                    way.x_of(study.reach_deg), study.pilot_deg);
    if (!springs) return springs.obstacle();
    study.springs = *std::move(springs);
  }
  return study;
}

}  // namespace misalign::solver
