// Lists the studies. A new study X needs four files, solver/ROOM/X, schema/exchange/X_json,
// search/sheets/X_text and search/verbs/X, and its line here. Help, the options of `report`, the
// page's columns and the functions of SQL follow from the table.
#include "schema/catalogue/study_table.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::schema {
namespace {

constexpr StudyColumn kOfDeployment[] = {
    {"deploy_time_s", "deploy time", "s",
     "Time from release at rest until the sheet is first flat. The design gives release angle, "
     "springs, hinges and panels; by default 36° (or D if less), no friction, and panels of 1 mm "
     "and 2.7 g/cm³.",
     Cost::motion, true, true},
    {"critical_friction_n_mm_per_mm", "critical friction", "N mm/mm",
     "Largest friction of the creases with which the released sheet still reaches flat.",
     Cost::path, false, true, true},
    {"stall_deg", "stall", "deg",
     "Pilot angle at which the design’s friction would stop a quasi-static motion; 0 if it reaches "
     "flat.",
     Cost::path, true},
    {"landing_rate_deg_per_s", "landing rate", "deg/s",
     "Rate of the pilot angle when the released sheet is first flat.", Cost::motion, true},
    {"bent_energy_n_mm", "energy, bent", "N mm",
     "Strain energy of springs and bending panels at the release angle; panels of the design’s "
     "material (aluminium by default).",
     Cost::motion},
    {"bent_critical_friction_n_mm_per_mm", "critical friction, bent", "N mm/mm",
     "Largest friction of the creases with which a sheet with bending panels still reaches flat, "
     "by its strain energy.",
     Cost::motion},
    {"static_friction_n_mm_per_mm", "static friction, bent", "N mm/mm",
     "Largest friction that a sheet with bending panels overcomes from rest at every angle, from "
     "release down to the design’s margin_to_deg (1° by default).",
     Cost::motion, false, false, true},
    {"static_margin", "static margin", "",
     "Static friction over the design’s friction, less 1, at the worst angle; none without "
     "friction.",
     Cost::motion}};
constexpr StudyColumn kOfContact[] = {
    {"first_contact_deg", "first contact", "deg",
     "Pilot angle at which panels without thickness first meet; none if they never do.",
     Cost::contact},
    {"thickness_mm", "thickness", "mm",
     "Largest thickness of plates that fold from flat to the design’s from_deg (D by default), "
     "tapered to hinges at their mid-planes and trimmed as usual; 0 if panels meet before.",
     Cost::contact}};
constexpr StudyColumn kOfActuators[] = {
    {"energy_n_mm", "energy", "N mm",
     "Strain energy of the design’s springs on all diagonals at its from_deg (D by default).",
     Cost::path},
    {"chosen_friction_n_mm_per_mm", "friction, chosen springs", "N mm/mm",
     "Largest friction that springs overcome from rest at every angle, panels rigid, if each may "
     "have any rate up to the design’s and any free length within 5 % of its flat diagonal’s.",
     Cost::motion}};
constexpr StudyColumn kOfFolding[] = {
    {"curvature_1_per_m", "curvature", "1/m",
     "Principal curvature of larger magnitude, in the middle, of the quadric fitted between the "
     "two levels of the sheet’s folds at from_deg (D by default); positive of a dome seen from "
     "above. None of sheets that are rolled up, or have fewer than four inner rows or columns.",
     Cost::path},
    {"curvature_2_per_m", "other curvature", "1/m",
     "The other principal curvature: about zero of an arch, of the same sign for a dome, of the "
     "opposite for a saddle or twist.",
     Cost::path}};

constexpr StudyColumn kOfShape[] = {
    {"shape_rms_mm", "distance from shape", "mm",
     "Root mean square of the distances from the target of a campaign that searches by shape; none "
     "where the sheet does not fold to its angle.",
     Cost::path, true},
    {"shape_max_mm", "largest distance from shape", "mm", "Largest of those distances.", Cost::path,
     true},
    {"stop_stiffness_mm2_per_rad2", "stiffness of the stop", "mm²/rad²",
     "Sum of (dL/dρ)² over all diagonals where the sheet has that shape; times the stiffness of "
     "springs that are relaxed there (N/mm) it is the stop’s, in N mm/rad, panels rigid.",
     Cost::path}};

constexpr StudyEntry kStudies[] = {
    {"deploy", "deployment of one sheet: its motion, friction and equilibria",
     "also deployment time and critical friction of the table's candidates (some milliseconds "
     "each)",
     kOfDeployment},
    {"contact", "contact of one sheet's panels, and their largest thickness",
     "also first contact of panels of each sheet shown in detail (about a tenth of a second each)",
     kOfContact},
    {"actuators", "springs on the diagonals of one sheet: energy, moments, forces", nullptr,
     kOfActuators},
    {"fold", "curvatures of one folded sheet", nullptr, kOfFolding},
    {"shape", "a sheet that has a target shape, and its distances from it", nullptr, kOfShape},
    {"stress", "deployment and stresses of one sheet with elastic panels (CalculiX)"},
    {"tolerance", "yield of a sheet's miscut copies, or the play that its joints bear"},
    {"optimise",
     "a better sheet near a given one: maximises critical friction or another objective"},
    {"card", "a design's requirements of one sheet and their results, on one page"},
    {"certify", "proof that a sheet folds in one way and its diagonals are monotone, up to D"}};

}  // namespace

std::span<const StudyEntry> study_table() { return kStudies; }

const StudyEntry& study_named(std::string_view name) {
  const auto* const entry = std::ranges::find(kStudies, name, &StudyEntry::name);
  assert(entry != std::end(kStudies));
  return *entry;
}

const StudyColumn* study_column(std::string_view name) {
  for (const StudyEntry& study : kStudies) {
    for (const StudyColumn& column : study.columns) {
      if (column.name == name) return &column;
    }
  }
  return nullptr;
}

std::vector<std::string> study_functions() {
  std::vector<std::string> names;
  for (const StudyEntry& study : kStudies) {
    for (const StudyColumn& column : study.columns) names.emplace_back(column.name);
  }
  return names;
}

bool StudyEntry::has_columns_in_report() const {
  return std::ranges::any_of(columns, &StudyColumn::in_report);
}

}  // namespace misalign::schema
