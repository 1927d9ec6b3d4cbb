#include "search/sheets/shaped.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/pattern/fill_words.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/studies.hpp"

namespace misalign::search {
namespace {

// The stowed angle of a file that names none, beyond its shape.
constexpr double kStowedBeyond_deg = 15;
// A well this near the shape is the shape's.
constexpr double kAtShape_deg = 0.1;

using schema::UserError;
using solver::OptionFault;
using solver::ShapeKind;

// Upper bounds have no price in a shape, numbers of miscut copies and of proofs no gradient.
void refuse_bounds(const schema::OptimiseBounds& bounds) {
  std::string name = bounds.stroke_max        ? "stroke_max"
                     : bounds.largest_force_n ? "largest_force_n"
                                              : "";
  for (const auto& [goal, least] : bounds.floors) {
    if (goal->is_to_be_small) name = goal->name;
    if (!goal->needs_threshold && !goal->needs_copies && !goal->is_proven_angle) continue;
    throw UserError(OptionFault{"subject_to", std::string(goal->name),
                                "is a number of miscut copies or of a proof, and a shape keeps "
                                "those of one folded sheet alone",
                                "take it out, and call `misalign optimise` for the shaped sheet"});
  }
  if (name.empty()) return;
  throw UserError(OptionFault{"subject_to", name,
                              "is an upper bound, and a shape keeps lower bounds of goals alone",
                              "take it out, and call `misalign optimise` for the shaped sheet"});
}

void check_angles(const schema::Pattern& base, const solver::ShapeOptions& options) {
  const auto refuse = [](const char* name, double deg, const std::string& why,
                         const std::string& instead) {
    throw UserError(OptionFault{name, solver::shown("%.10g", deg), why, instead});
  };
  const double end_deg = base.base.folding.end_deg();
  if (options.at_deg >= end_deg) {
    refuse("at_deg", options.at_deg,
           fmt::format("the sheet that is not shifted folds to {:.4g} deg only", end_deg),
           "name a smaller angle");
  }
  if (options.kind != ShapeKind::free && options.from_deg <= options.at_deg) {
    refuse("from_deg", options.from_deg,
           fmt::format("a sheet that is shaped at {:g} deg is stowed beyond that", options.at_deg),
           "name a larger angle");
  }
}

solver::ShapeOptions options_of(const schema::PatternFile& file, const ShapeInput& input,
                                schema::Design& design) {
  solver::ShapeOptions options = input.options;
  options.target = file.target->shape;
  options.at_deg = input.at_deg.value_or(shape_deg(*file.target, design.rest_deg));
  options.from_deg = design.from_deg.value_or(options.at_deg + kStowedBeyond_deg);
  check_angles(file.pattern, options);
  refuse_bounds(input.bounds);
  design.from_deg = options.from_deg;
  design.rest_deg = std::nullopt;
  if (options.kind == ShapeKind::rest || options.kind == ShapeKind::rest_by_energy) {
    design.rest_deg = options.at_deg;
  }
  if (options.kind != ShapeKind::free) {
    schema::need_plain_springs(design.fill(file.pattern.base), "`misalign shape`");
    options.barrier_mm = std::sqrt(2 * input.barrier_n_mm / design.springs().stiffness_n_per_mm);
  }
  return options;
}

}  // namespace

const schema::Target& target_of(const std::optional<schema::Target>& target,
                                const std::string& name) {
  if (target) return *target;
  throw UserError(schema::Cause::bad_input,
                  name + R"(: has no "target", so there is no shape to find; write "target": )"
                         R"({"surface": "sphere", "radius_mm": 1440} beside the pattern)");
}

double shape_deg(const schema::Target& target, const std::optional<double>& rest_deg) {
  return target.at_deg.value_or(rest_deg.value_or(schema::kShape_deg));
}

ShapedSheet shaped(const schema::PatternFile& file, const std::string& name,
                   const ShapeInput& input) {
  target_of(file.target, name);
  ShapedSheet made;
  made.design = file.design;
  made.options = options_of(file, input, made.design);
  solver::ShapeOptions& options = made.options;
  const FoldingModel design_model(file.pattern, file.sampling, made.design);
  const solver::Model model(file.pattern.base, {.end_deg = file.sampling.end_deg},
                            file.sampling.criterion());
  solver::SheetSolver solver(model);
  const solver::Sheet base(solver, Eigen::Matrix2Xd::Zero(2, file.pattern.shifts_mm.cols()), name);
  options.keeping.floors = input.bounds.floors;
  options.keeping.shifted = solver::all_vertices(file.pattern.base.sheet);
  options.keeping.deploying = deploy_options(made.design, base);
  options.keeping.bending = bending(made.design);
  made.study =
      value_or_throw(solver::shape(solver, options), name, "it is not shaped to its target");
  const solver::Sheet sheet(solver, made.study.shifts_mm, name);
  made.contact = contact_of(sheet, {}).first;
  if (options.kind == ShapeKind::free) return made;
  made.used_from_deg = made.study.driven_from_deg;
  if (made.contact) made.used_from_deg = std::min(made.used_from_deg, made.contact->pilot_deg);
  if (file.pattern.base.springs.in_mid_plane()) {
    const double to_deg = made.used_from_deg > 0 ? made.used_from_deg : options.from_deg;
    made.wells =
        value_or_throw(solver::prove_wells(sheet, made.design.fill(file.pattern.base), to_deg),
                       name, "its wells are not known");
    made.used_from_deg = std::min(made.used_from_deg, made.wells->proven_deg);
    if (options.kind == ShapeKind::rest && made.used_from_deg > 0) {
      RowCertifier certifier(file.pattern, model);
      made.used_from_deg =
          certifier.certify(0, made.study.shifts_mm, made.used_from_deg).certified_deg;
    }
  }
  // Angles beyond the proof, or beyond contact, are taken back.
  made.design.from_deg = std::nullopt;
  if (made.used_from_deg > options.at_deg) made.design.from_deg = made.used_from_deg;
  return made;
}

schema::Json shaped_pattern(const schema::PatternFile& file, const ShapedSheet& shaped) {
  schema::Target target = *file.target;
  target.json["at_deg"] = shaped.options.at_deg;
  return schema::pattern_file_json(file.pattern, shaped.study.shifts_mm, file.sampling,
                                   shaped.design, target);
}

}  // namespace misalign::search
