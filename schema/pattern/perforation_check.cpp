#include "schema/pattern/perforation_check.hpp"

#include "solver/kinematics/mechanism.hpp"
#include "solver/linear/mobility.hpp"
#include "solver/pattern/parallel_family.hpp"

namespace misalign::schema {
namespace {

// Checks that an overconstrained sheet folds nevertheless; `constraints` says that it is
// overconstrained.
void check_member(const std::string& where, const std::string& constraints, const Pattern& pattern,
                  InputFaults& faults) {
  const solver::CreasePattern& sheet = pattern.base.sheet;
  const auto family = solver::ParallelFamily::of(pattern.base, solver::all_vertices(sheet));
  if (const auto* none = std::get_if<solver::NoParallelFamily>(&family)) {
    faults.add(where, constraints + "; nor has the base a parallel family: " + none->why(sheet),
               "`misalign perforations` lists those that leave one");
    return;
  }
  const solver::ParallelMisfit misfit = solver::parallel_misfit(pattern.base, pattern.shifts_mm);
  if (misfit.mm <= solver::kMemberWithin_mm) return;
  std::string place;
  for (const int v : misfit.vertices) place += (place.empty() ? "" : "-") + solver::vertex_label(v);
  faults.add(where,
             constraints +
                 "; in an overconstrained sheet creases must keep their directions and holes stay "
                 "parallelograms, and the shifts take " +
                 place + " off by " + shown_number(misfit.mm) + " mm",
             "`misalign construct` shifts vertices so that the sheet folds");
}

// Suggests a remedy for a sheet without holes.
std::string hole_advice(const solver::CreasePattern& sheet) {
  const int count = solver::holes_that_count_to_one(sheet);
  const auto inner = static_cast<int>(solver::inner_facets(sheet).size());
  if (inner == 0) {
    return "give a sheet of more panels: only those away from its border can be taken out";
  }
  if (count < 1 || count > inner) {
    return "give another sheet: by counting (2.1) no number of its holes leaves one degree of "
           "freedom";
  }
  return "take out " + std::to_string(count) + (count == 1 ? " inner panel" : " inner panels") +
         "; `misalign perforations` lists which";
}

}  // namespace

bool is_overconstrained(const solver::PerforatedSheet& base) {
  const solver::Mechanism mechanism = solver::build_mechanism(base);
  return mechanism.equations >= mechanism.unknowns;
}

bool closes_at_180(const solver::PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm) {
  double misfit_rad = 0;
  return base.folding.end_deg() >= 180 && !shifts_mm.isZero(0) &&
         solver::parallel_misfit(base, shifts_mm).mm <= solver::kMemberWithin_mm &&
         !is_overconstrained(base) &&
         std::holds_alternative<std::vector<solver::BaseHole>>(
             solver::base_holes(base, misfit_rad));
}

// Checks by counting, then by the rank of the Jacobian, which decides.
void check_perforation(const std::string& where, const Pattern& pattern, Perforations perforations,
                       InputFaults& faults) {
  const solver::PerforatedSheet& base = pattern.base;
  if (base.holes.empty()) {
    faults.add(where, "there is no hole, so there is no diagonal to measure",
               hole_advice(base.sheet));
    return;
  }
  const int counted = solver::counted_mobility(base.sheet, base.holes);
  const solver::Mobility measured = solver::measured_mobility(base.sheet, base.holes, base.folding);
  if (measured.is_one()) return;
  const std::string numbers = "the Jacobian has rank " + std::to_string(measured.rank) + " with " +
                              std::to_string(measured.unknowns) + " unknowns and " +
                              std::to_string(measured.equations) +
                              " equations; counting (2.1) gives " + std::to_string(counted);
  const int rows = base.sheet.places.back()[0] + 1, columns = base.sheet.places.back()[1] + 1;
  const bool odd = pattern.family["family"] == "miura" && (rows % 2 == 1 || columns % 2 == 1);
  const bool odd_checkerboard = odd && (base.holes == solver::checkerboard(base.sheet, 0) ||
                                        base.holes == solver::checkerboard(base.sheet, 1));
  const std::string first =
      odd_checkerboard ? "rows and columns must both be even for a checkerboard of holes, "
                         "and are " +
                             std::to_string(rows) + " and " + std::to_string(columns) + ": "
                       : "";
  const std::string suggestion =
      odd ? "make rows and columns even" : "`misalign perforations` lists those that leave one";
  if (measured.rank < measured.equations && measured.degrees_of_freedom() == 1) {
    const std::string constraints =
        first +
        "the perforation leaves too many constraints, so that shifted sheets do not fold: " +
        numbers;
    if (perforations == Perforations::of_one_path) {
      check_member(where, constraints, pattern, faults);
    } else {
      faults.add(where, constraints,
                 suggestion +
                     "; members of the base's parallel family fold nevertheless: in a campaign "
                     "with \"kind\": \"parallel\", or by `misalign construct`");
    }
  } else {
    faults.add(where,
               first + "the perforation leaves " + std::to_string(measured.degrees_of_freedom()) +
                   " degrees of freedom, not 1: " + numbers,
               suggestion);
  }
}

}  // namespace misalign::schema
