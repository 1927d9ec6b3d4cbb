// `misalign construct`: a sheet whose diagonals are monotone to 180 degrees, without a search.
#include <fmt/format.h>

#include <algorithm>

#include "schema/exchange/construct_json.hpp"
#include "schema/files/output_file.hpp"
#include "schema/pattern/design_json.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/studies.hpp"
#include "search/sheets/study_texts.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

constexpr double kLeastAt_deg = 1;  // pilot angle of strokes

struct ConstructCall {
  std::string pattern_path;  // its displacements are ignored
  std::string output_path;   // empty: no file
  solver::ConstructOptions options;
  std::optional<double> at_deg;  // none: the design's angle of use
  std::string signs;             // as typed: '+' and '-'
  bool rim = false, json = false;
};

std::vector<int> signs_of(const std::string& typed) {
  std::vector<int> signs;
  for (const char sign : typed) signs.push_back(sign == '+' ? 1 : -1);
  return signs;
}

void construct_sheet(ConstructCall& call) {
  const schema::PatternFile read =
      schema::read_sampled_pattern_file(call.pattern_path, schema::Perforations::any);
  const schema::Pattern& base = read.pattern;
  say_reading(call.pattern_path, base);
  call.options.signs = signs_of(call.signs);
  if (call.at_deg) {
    call.options.at_deg = *call.at_deg;
  } else if (read.design.from_deg) {
    call.options.at_deg = std::clamp(*read.design.from_deg, kLeastAt_deg, call.options.at_deg);
  }
  const solver::ConstructStudy study = constructed(base, call.pattern_path, call.rim, call.options);
  if (!call.output_path.empty()) {
    schema::Json made = schema::pattern_json(base, study.shifts_mm);
    const schema::Json design = schema::explicit_design_json(read.design);
    if (!design.empty()) made["design"] = design;
    schema::write_text_file(call.output_path, made.dump(1) + "\n");
  }
  if (call.json) {
    put_json(schema::construct_json(base, study, call.options.at_deg));
  } else {
    put(construct_text(base, study, call.options.at_deg));
  }
}

// '+' or '-', one a hole.
CLI::Validator plus_or_minus() {
  return {[](const std::string& typed) {
            return typed.find_first_not_of("+-") == std::string::npos
                       ? std::string()
                       : "signs are written as + and -, one a hole: +-+-";
          },
          "SIGNS"};
}

}  // namespace

Action construct_verb(CLI::App& verb) {
  verb.description("a sheet that is monotone to 180 degrees by construction, without a search");
  verb.footer(
      "Makes the sheet of the base's parallel family whose smallest stroke is largest: every\n"
      "crease keeps its direction and holes stay parallelograms, so that the sheet folds by the\n"
      "base's angles and the diagonals' lengths are closed forms. With the rim held signs must\n"
      "change along each row and column of holes. The proof, and which bases have the family:\n"
      "solver/pattern/README.md. `misalign certify` proves the same from the loop equations.\n"
      "Examples:\n"
      "  misalign construct search/patterns/table1.json --amplitude 4 --output made.json\n"
      "  misalign construct search/patterns/miura-graded-6x6.json --rim --stroke 0.01 --amplitude "
      "2\n"
      "  misalign certify made.json --to 179.9");
  auto call = std::make_shared<ConstructCall>();
  verb.add_option("PATTERN", call->pattern_path, "base pattern (JSON)")->required();
  verb.add_option("--output", call->output_path, "write the sheet to this pattern file")
      ->type_name("FILE");
  add_value(verb, "--amplitude", call->options.amplitude_mm,
            "largest shift of a vertex in x or y, mm [0.4]", within(1e-6, 1e6), "MM");
  add_value(verb, "--stroke", call->options.stroke,
            "smallest stroke of any diagonal, a share of its length [the largest possible]",
            a_share(1e-6, 1), "SHARE");
  add_value(verb, "--at", call->at_deg,
            "pilot angle of the stroke, degrees [the design's angle of use, or 179]",
            within(kLeastAt_deg, 180), "DEG");
  verb.add_option("--signs", call->signs,
                  "sign of each hole's change, row by row [several are tried]")
      ->check(plus_or_minus());
  verb.add_flag("--rim", call->rim, "also shift the rim's vertices");
  verb.add_flag("--json", call->json, "as JSON, with the sheet as \"pattern\"");
  return showing(call, construct_sheet);
}

}  // namespace misalign::search
