#include "search/sheets/construct_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "search/sheets/found_study.hpp"
#include "solver/linear/mobility.hpp"

namespace misalign::search {
namespace {

using schema::Cause;
using schema::UserError;

void check_freedom(const schema::Pattern& base, const std::string& path) {
  const solver::PerforatedSheet& sheet = base.base;
  if (sheet.holes.empty()) {
    throw UserError(Cause::bad_input,
                    path +
                        ": there is no hole (what is constructed are holes whose diagonals "
                        "change); name inner panels in \"holes\"");
  }
  const auto mobility = solver::measured_mobility(sheet.sheet, sheet.holes, sheet.folding);
  if (mobility.degrees_of_freedom() == 1) return;
  throw UserError(
      Cause::bad_input,
      fmt::format("{}: its holes leave {} degrees of freedom (the Jacobian has rank {} "
                  "with {} unknowns); take out fewer panels",
                  path, mobility.degrees_of_freedom(), mobility.rank, mobility.unknowns));
}

}  // namespace

std::string construct_text(const schema::Pattern& base, const solver::ConstructStudy& study,
                           double at_deg) {
  std::string text = fmt::format(
      "stroke       every diagonal changes by {:.4g} % or more at {:g} deg\n"
      "shifts       up to {:.6g} mm in x or y\n"
      "folds        by the base's own fold angles, to 180 deg: creases keep their directions, and\n"
      "             opposite edges of holes change alike (to {:.1e} mm)\n",
      100 * study.stroke, at_deg, study.amplitude_mm, study.misfit_mm);
  text += study.is_monotone()
              ? "diagonals    each only grows or only shrinks from flat to 180 deg (closed form)\n"
              : "diagonals    not all go one way to 180 deg; `misalign fold` says how far\n";
  text += fmt::format("family       {} coordinates\n\n", study.dimension);
  text += "hole       delta_mm  epsilon_mm  stroke_%  goes one way\n";
  for (const solver::ConstructedHole& hole : study.holes) {
    text += fmt::format("{:<9} {:>9.5f} {:>11.5f} {:>9.3f}  {}\n",
                        schema::facet_json(base, hole.facet).dump(), hole.delta_mm, hole.epsilon_mm,
                        100 * hole.stroke, hole.direction != 0 ? "yes" : "no");
  }
  return text;
}

solver::ConstructStudy constructed(const schema::Pattern& base, const std::string& path, bool rim,
                                   const solver::ConstructOptions& options) {
  check_freedom(base, path);
  const solver::CreasePattern& sheet = base.base.sheet;
  auto family = solver::ParallelFamily::of(
      base.base, rim ? solver::all_vertices(sheet) : solver::interior_vertices(sheet));
  if (const auto* none = std::get_if<solver::NoParallelFamily>(&family)) {
    throw UserError(Cause::bad_input, path + ": " + none->why(sheet) +
                                          ", so sheets of it are not constructed; search for "
                                          "them: misalign search");
  }
  return found(solver::construct(base.base, std::get<solver::ParallelFamily>(family), options),
               path);
}

}  // namespace misalign::search
