// `misalign shape`: a sheet that has a target shape on its way.
#include "schema/exchange/shape_json.hpp"
#include "schema/files/output_file.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/shaped.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

constexpr double kMostShapeShift_mm = 1e6, kMostBarrier_n_mm = 1e9;

struct ShapeCall {
  std::string path, output, target;
  schema::Design design;
  ShapeInput input;
  std::vector<std::string> subject_to;
  bool json = false;
};

// The file, with a typed target in place of its own.
schema::PatternFile file_of(const ShapeCall& call) {
  schema::PatternFile file = schema::read_sampled_pattern_file(call.path);
  if (call.target.empty()) return file;
  schema::InputFaults faults;
  file.target = schema::read_target(schema::parse_json(call.target, "--target"), "target",
                                    file.pattern.base.sheet, "", faults);
  faults.refuse("--target");
  return file;
}

void shape_sheet(ShapeCall& call) {
  schema::PatternFile file = file_of(call);
  say_reading(call.path, file.pattern);
  file.design = call.design.merged_over(file.design);
  call.input.bounds = schema::bounds_of(call.subject_to);
  const ShapedSheet made = shaped(file, call.path, call.input);
  if (!call.output.empty()) {
    schema::write_text_file(call.output, shaped_pattern(file, made).dump(1) + "\n");
    const std::filesystem::path output = call.output;
    if (output.extension() == ".json") {
      const std::string name = output.stem().string();
      schema::write_text_file(output.parent_path() / (name + "-shape.svg"),
                              shape_picture(file, name, made));
    }
  }
  if (call.json) return put_json(shape_json(file, made));
  put(shape_text(file, call.path, made));
}

void add_limits(CLI::App& verb, ShapeCall& call) {
  solver::ShapeOptions& options = call.input.options;
  verb.add_flag("--hold-rim", options.is_rim_fixed, "shift no vertex of the rim");
  verb.add_option_function<double>(
          "--amplitude", [&options](double mm) { options.amplitude_mm = mm; },
          "largest shift of a vertex in x or y, mm [any]")
      ->check(within(1e-6, kMostShapeShift_mm))
      ->type_name("MM");
  add_default(verb, "--least-edge", options.least_edge,
              "least length of an edge, a share of the base's", a_share(0.01, 1), "SHARE");
  add_default(verb, "--least-sine", options.least_sine, "least sine of a corner of a panel or hole",
              a_share(0.01, 1), "SINE");
  add_default(verb, "--beyond", options.beyond_deg,
              "distance of the fold limit beyond the stowed angle, degrees", within(0.1, 90),
              "DEG");
  add_default(verb, "--least-slope", options.least_slope_mm_per_deg,
              "smallest slope of a diagonal, mm/deg at 90 deg and times the sine elsewhere: the "
              "drive",
              within("optimise", "least_slope_mm_per_deg"), "MM_PER_DEG");
  add_default(verb, "--barrier", call.input.barrier_n_mm,
              "least energy of a bistable sheet's springs between flat and the shape, N mm",
              within(0, kMostBarrier_n_mm), "N_MM");
  verb.add_option("--subject-to", call.subject_to,
                  "lower bound of a goal of `misalign optimise` (may be repeated): "
                  "\"thickness_mm >= 2\"")
      ->type_name("LIMIT");
}

}  // namespace

Action shape_verb(CLI::App& verb) {
  verb.description("a sheet that lies on a target surface on its way, and stops there");
  verb.footer(
      "Shifts all flat vertices so that the folded ones lie on the file's \"target\", half of\n"
      "them above it and half below it by half the fold's depth, while the holes keep the sheet\n"
      "driven: springs relaxed at the shape let it rest there, deployed from the stowed angle or\n"
      "self-folded from flat (--kind rest); or their energy alone does (energy); or springs\n"
      "relaxed flat rest there too (bistable). The result is folded, its wells are proven, and\n"
      "panels are checked for contact; the file that is written is used from the angle up to\n"
      "which all of this holds. Shifts in the file do not matter: the base is the start.\n"
      "Examples:\n"
      "  misalign shape search/patterns/dome-6x6.json --output dome.json\n"
      "  misalign shape search/patterns/dome-6x6.json --target '{\"surface\": \"saddle\", "
      "\"radius_mm\": 1440}' --from 98\n"
      "  misalign shape search/patterns/dome-6x6.json --subject-to \"thickness_mm >= 2\"");
  auto call = std::make_shared<ShapeCall>();
  solver::ShapeOptions& options = call->input.options;
  verb.add_option("PATTERN", call->path, "pattern file (JSON) with a \"target\"")->required();
  verb.add_option("--target", call->target,
                  "target in place of the file's, JSON; a mesh is sought in the present folder")
      ->type_name("JSON");
  Names<solver::ShapeKind> kinds;
  for (const auto& [name, kind] : schema::kShapeKinds) kinds.emplace_back(name, kind);
  verb.add_option("--kind", options.kind, "how springs hold it at its shape [rest]")
      ->transform(one_of(kinds));
  add_value(verb, "--at", call->input.at_deg,
            "pilot angle of the shape [the target's, or where the filling rests, or 90]",
            within(1, 179), "DEG");
  add_from(verb, call->design.from_deg, "[the design's, or 15 beyond the shape]");
  add_limits(verb, *call);
  add_stiffness(verb, call->design.stiffness_n_per_mm);
  add_thickness(verb, call->design.thickness_mm);
  verb.add_option("--output", call->output,
                  "write the sheet to this pattern file, and a picture of it beside that "
                  "(NAME-shape.svg of NAME.json)")
      ->type_name("FILE");
  verb.add_flag("--json", call->json, "as JSON, with the sheet as \"pattern\"");
  return showing(call, shape_sheet);
}

}  // namespace misalign::search
