// `misalign fold`: the folding path of one pattern.
#include <algorithm>

#include "schema/pattern/pattern_file.hpp"
#include "schema/pattern/sampling.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/folding_text.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct FoldCall {
  std::string pattern_path;
  std::optional<double> to_deg;  // default: the file's end, or 180
  double step_deg = 0;           // step of further stations; 0: none
  bool json = false, table = false;
};

void fold(const FoldCall& call) {
  const auto [pattern, sampling, design, target, exported] =
      schema::read_sampled_pattern_file(call.pattern_path, schema::Perforations::of_one_path);
  say_reading(call.pattern_path, pattern);
  solver::PathPlanOptions path;
  path.sample_deg = sampling.sample_deg;
  path.end_deg =
      std::min(call.to_deg.value_or(sampling.end_deg),
               schema::last_judged_deg(pattern.base, pattern.shifts_mm, sampling.sample_deg));
  path.look_deg = call.step_deg;
  const solver::Model model(pattern.base, path, sampling.criterion());
  solver::SheetSolver solver(model);
  const solver::Sheet sheet(solver, pattern.shifts_mm);
  const schema::FoldingView view(pattern, sheet);
  const solver::Fill fill = fill_shown(sampling, design, pattern);
  if (!call.json) return put_folding(view, design, fill, call.table);
  schema::Json json = schema::folding_json(view);
  json["energy"] = schema::energy_json(view, fill);
  if (pattern.folded_target) json["target"] = schema::target_json(view, fill);
  put_json(json);
}

}  // namespace

Action fold_verb(CLI::App& verb) {
  verb.description("the folding path of one pattern");
  verb.footer(
      "Each diagonal is drawn from flat to the end of the path, between its least and\n"
      "its largest length. A bar marks D, the pilot angle that the sheet deploys from (here\n"
      "D is an angle; in the paper it is a ratio).\n"
      "Lengths and elongations are those up to D, or up to the end of the path if D is 0.\n"
      "An exported candidate, JSON or FOLD, is sampled as its campaign was; any other\n"
      "pattern at every degree to 180.\n\n"
      "Examples:\n"
      "  misalign fold search/patterns/table1.json\n"
      "  misalign fold search/patterns/table1.json --json > table1-folding.json");
  auto call = std::make_shared<FoldCall>();
  verb.add_option("PATTERN", call->pattern_path,
                  "pattern file (JSON), exported candidate, FOLD file, or flat mesh in OBJ")
      ->required();
  add_value(verb, "--to", call->to_deg,
            "follow the path to this pilot angle, degrees [180, or the campaign's]", within(1, 180),
            "DEG");
  add_value(verb, "--step", call->step_deg, "also sample every multiple of this angle, degrees",
            within(0.01, 180), "DEG");
  verb.add_flag("--table", call->table,
                "print the lengths every 10 degrees even where they are too wide for the terminal");
  verb.add_flag("--json", call->json, "as JSON");
  return showing(call, fold);
}

}  // namespace misalign::search
