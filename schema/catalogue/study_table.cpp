// A new study X needs four files, solver/ROOM/X, schema/exchange/X_json, search/sheets/X_text and
// search/verbs/X, and its line here. Help, the options of `report`, the page's columns and what SQL
// may call follow from the table.
#include "schema/catalogue/study_table.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::schema {
namespace {

constexpr StudyColumn kOfDeployment[] = {
    {"deploy_time_s", "deploy time", "s",
     "When it is flat, let go at rest as the design says: from_deg (otherwise 20 % folded, 36°, or "
     "D where that is less), its springs, hinges and panels (otherwise 1 mm of 2.7 g/cm³, without "
     "friction).",
     Cost::motion, true, true},
    {"critical_friction_n_mm_per_mm", "critical friction", "N mm/mm",
     "The most friction of the creases, per mm, with which it then still gets to flat.", Cost::path,
     false, true},
    {"stall_deg", "stall", "deg",
     "Where the design’s friction would stop it, if it then moved slowly; 0 where it gets to flat.",
     Cost::path, true},
    {"landing_rate_deg_per_s", "landing rate", "deg/s",
     "How fast the pilot then turns when it is first flat.", Cost::motion, true},
    {"bent_energy_n_mm", "energy, bent", "N mm",
     "Of springs and panels there, if panels bend: of the design’s material (otherwise aluminium).",
     Cost::motion},
    {"bent_critical_friction_n_mm_per_mm", "critical friction, bent", "N mm/mm",
     "The most friction of the creases with which it gets to flat, let go slowly, if panels bend.",
     Cost::motion},
    {"static_friction_n_mm_per_mm", "static friction, bent", "N mm/mm",
     "The most friction with which it moves on at every angle, if panels bend: from the start down "
     "to the design’s margin_to_deg (otherwise 1°).",
     Cost::motion},
    {"static_margin", "static margin", "",
     "That over the design’s friction, less 1, the least of all angles; none without friction.",
     Cost::motion}};
constexpr StudyColumn kOfContact[] = {
    {"first_contact_deg", "first contact", "deg",
     "The pilot angle at which panels without thickness first meet; none where they do not.",
     Cost::contact},
    {"thickness_mm", "thickness", "mm",
     "How thick plates may be to fold from flat to the design’s from_deg (otherwise D), hinged at "
     "the mid-plane, tapered, and with the usual trim; 0 where panels meet on the way.",
     Cost::contact}};
constexpr StudyColumn kOfActuators[] = {
    {"energy_n_mm", "energy", "N mm",
     "Stored by the design’s springs on all diagonals at its from_deg (otherwise D).", Cost::path}};

constexpr StudyEntry kStudies[] = {
    {"deploy", "lets one sheet go: its motion, friction, equilibria",
     "in the table also when candidates that are let go are flat, and what friction they overcome "
     "(some milliseconds each)",
     kOfDeployment},
    {"contact", "where the panels of one sheet meet, and how thick they may be",
     "also where panels first meet, of each sheet that can be looked at closely (about a tenth of "
     "a second each)",
     kOfContact},
    {"actuators", "springs on the diagonals of one sheet", nullptr, kOfActuators},
    {"stress", "elastic panels, let go: do they deploy, and what do they suffer (CalculiX)"},
    {"tolerance", "how many miscut copies of a sheet still deploy, or how loose its joints may be"},
    {"optimise", "a better sheet near one: by what friction it overcomes, or another goal"},
    {"card", "what a design asks of one sheet, and what was found, on one page"},
    {"certify", "prove that a sheet folds in one way, and its diagonals go one way, up to D"}};

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
