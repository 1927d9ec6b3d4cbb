#include <fmt/format.h>

#include <cassert>

#include "schema/exchange/certify_json.hpp"
#include "schema/exchange/contact_json.hpp"
#include "schema/exchange/shape_json.hpp"
#include "schema/exchange/target_view.hpp"
#include "schema/files/json_values.hpp"
#include "search/sheets/certify_text.hpp"
#include "search/sheets/shaped.hpp"
#include "search/terminal/count_text.hpp"

namespace misalign::search {
namespace {

using solver::ShapeKind;
using solver::ShapeRow;

// The shaped sheet, folded again by a model of its own.
struct Folded {
  Folded(const schema::PatternFile& file, const ShapedSheet& shaped, const std::string& name)
      : model(file.pattern.base, {.end_deg = file.sampling.end_deg}, file.sampling.criterion()),
        solver(model),
        sheet(solver, shaped.study.shifts_mm, name) {}
  const solver::Model model;
  solver::SheetSolver solver;
  const solver::Sheet sheet;
};

std::string held_text(const ShapedSheet& shaped) {
  const auto& [options, study] = std::tie(shaped.options, shaped.study);
  switch (options.kind) {
    case ShapeKind::free:
      return "";
    case ShapeKind::rest:
      return fmt::format(
          "held by springs relaxed there; all diagonals are monotone from {:g} deg\n",
          study.deploys_from_deg);
    case ShapeKind::rest_by_energy:
      return fmt::format(
          "held by springs relaxed there; their energy falls to it from {:.4g} deg and from flat\n",
          study.driven_from_deg);
    case ShapeKind::bistable:
      return "held by springs relaxed flat, which are as long at the shape\n";
  }
  return "";
}

const char* unit_of(ShapeRow::Kind kind) {
  switch (kind) {
    case ShapeRow::Kind::fold:
    case ShapeRow::Kind::limit:
      return "deg";
    case ShapeRow::Kind::corner:
      return "unit of its sine";
    case ShapeRow::Kind::floor:
      return "unit of the goal";
    default:
      return "mm";
  }
}

std::string limits_text(const schema::PatternFile& file, const solver::Sheet& sheet,
                        const ShapedSheet& shaped) {
  if (shaped.study.limits.empty()) return "";
  std::string text =
      "limits, and the share by which the objective falls per unit that each is relaxed:\n";
  for (const solver::ShapeLimit& limit : shaped.study.limits) {
    std::string name = schema::name_of(limit.kind);
    std::ranges::replace(name, '_', ' ');
    const std::string place =
        schema::place_of(file.pattern, sheet.mechanism(), shaped.options, limit);
    if (!place.empty()) name += " " + place;
    if (limit.pilot_deg > 0) name += fmt::format(" at {:.4g} deg", limit.pilot_deg);
    const char* const unit = unit_of(limit.kind);
    text += fmt::format("  {:<34} {:.3g} % per {}", name, 100 * limit.price, unit);
    if (limit.missing > 0) text += fmt::format("; violated by {:.3g} {}", limit.missing, unit);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string shape_text(const schema::PatternFile& file, const std::string& name,
                       const ShapedSheet& shaped) {
  const Folded folded(file, shaped, name);
  const solver::ShapeStudy& study = shaped.study;
  const double width_mm = file.pattern.base.sheet.panel_width_mm *
                          std::sqrt(static_cast<double>(file.pattern.base.sheet.facet_count()));
  std::string text = fmt::format(
      "{}: {} at {:g} deg; {}, {} folded\n"
      "distance   {:.3g} mm rms, {:.3g} mm maximum: {:.1e} and {:.1e} of the sheet's {:g} mm\n"
      "shifts     up to {:.4g} mm; half the fold's depth {:.4g} mm\n",
      name, schema::target_words(*file.target), shaped.options.at_deg,
      count_text(static_cast<std::uint64_t>(study.steps), "step"),
      count_text(static_cast<std::uint64_t>(study.evaluations), "sheet"), study.rms_mm,
      study.max_mm, study.rms_mm / width_mm, study.max_mm / width_mm, width_mm,
      study.shifts_mm.colwise().norm().maxCoeff(), std::abs(study.pose.half_depth_mm));
  if (!study.is_reached) {
    text +=
        "not reached: a limit is violated, or the sheet lies farther from the target than "
        "shapes that it can have; the limits below say what stands in the way\n";
  }
  text += held_text(shaped);
  if (const solver::FoldingWay& way = *folded.sheet.way(); way.ends_at_limit()) {
    text += fmt::format("fold limit {:.2f} deg\n", way.end_deg());
  }
  if (shaped.wells) text += wells_text(folded.sheet, *shaped.wells);
  if (shaped.contact) {
    text +=
        fmt::format("contact    {} meet at {:.4g} deg\n",
                    schema::panels_text(file.pattern, folded.sheet.panels(), shaped.contact->pair),
                    shaped.contact->pilot_deg);
  }
  if (shaped.options.kind != ShapeKind::free) {
    text += shaped.design.from_deg
                ? fmt::format("use        from {:.5g} deg\n", *shaped.design.from_deg)
                : std::string("use        not proven from any angle beyond the shape's\n");
  }
  return text + limits_text(file, folded.sheet, shaped);
}

std::string shape_picture(const schema::PatternFile& file, const std::string& name,
                          const ShapedSheet& shaped) {
  Folded folded(file, shaped, name);
  const double at_deg = shaped.options.at_deg;
  const auto measure = solver::ShapeMeasure::of(folded.solver, file.target->shape, at_deg);
  assert(measure && "it was shaped there");
  return schema::shape_picture(
      fmt::format("{} on {} at {:g}°", name, schema::target_words(*file.target), at_deg),
      folded.sheet.panels(),
      schema::target_view(folded.sheet.panels(), folded.sheet.at(at_deg).vertices_mm, *measure));
}

schema::Json shape_json(const schema::PatternFile& file, const ShapedSheet& shaped) {
  const Folded folded(file, shaped, "the shaped sheet");
  schema::Json json =
      schema::shape_json(file.pattern, *file.target, folded.sheet, shaped.options, shaped.study);
  json["used_from_deg"] = schema::or_null(shaped.design.from_deg);
  json["wells"] =
      shaped.wells ? schema::wells_json(folded.sheet.mechanism(), *shaped.wells) : schema::Json();
  json["contact"] = shaped.contact
                        ? schema::contact_json(file.pattern, folded.sheet.panels(), *shaped.contact)
                        : schema::Json();
  json["pattern"] = shaped_pattern(file, shaped);
  return json;
}

}  // namespace misalign::search
