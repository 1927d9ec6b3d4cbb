// To add a study: its four files, solver/design/X, schema/exchange/X_json, search/sheets/X_text and
// search/verbs/X, and its line here. Help, the options of `report`, the page's columns and what SQL
// may call follow from the table.
#include "schema/catalogue/study_table.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::schema {
namespace {

constexpr StudyColumn kOfDeployment[] = {
    {"deploy_time_s", "deploy time", "s",
     "When it is flat, let go at rest 20 % folded (36°) with the report’s springs, 1 mm panels of "
     "2.7 g/cm³, free in space and without friction.",
     true},
    {"critical_friction_n_mm_per_mm", "critical friction", "N mm/mm",
     "The most friction of the creases, per mm, with which it then still gets to flat."}};

constexpr StudyEntry kStudies[] = {
    {"deploy", "lets one sheet go: its motion, friction, equilibria",
     "in the table also when candidates that are let go are flat, and what friction they overcome "
     "(some milliseconds each)",
     kOfDeployment},
    {"contact", "where the panels of one sheet meet, and how thick they may be",
     "also where panels first meet, of each sheet that can be looked at closely (about a tenth of "
     "a second each)"},
    {"actuators", "springs on the diagonals of one sheet"},
    {"stress", "elastic panels, let go: do they deploy, and what do they suffer (CalculiX)"},
    {"tolerance", "how many miscut copies of a sheet still deploy, or how loose its joints may be"},
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

}  // namespace misalign::schema
