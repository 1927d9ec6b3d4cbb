// `misalign optimise`: ascends from a sheet to an optimum.
#include <fmt/format.h>

#include "schema/catalogue/study_table.hpp"
#include "schema/files/output_file.hpp"
#include "search/sheets/card_limits.hpp"
#include "search/sheets/card_text.hpp"
#include "search/sheets/study_json.hpp"
#include "search/sheets/study_texts.hpp"
#include "search/terminal/terminal.hpp"
#include "search/terminal/usable_threads.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/rank_options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct OptimiseCall : SheetCall {
  schema::Design design;
  std::string material, output;
  std::vector<std::string> subject_to;
  std::optional<solver::CertifiedBy> criterion;
  OptimiseInput input;
  bool with_card = false, keeps_card = false;
};

// The cards of the start and of the optimum.
struct Cards {
  schema::Card before, after;
};

Cards cards_of(const Subject& subject, const ProvenBetter& better) {
  const CardOptions options{.jobs = usable_threads()};
  const Subject end(sheet_of_made_pattern(better_pattern(subject, better), "the optimised sheet"),
                    {});
  return {card_of(subject, options).card, card_of(end, options).card};
}

void show_optimised(OptimiseCall call) {
  read_material(call.material, call.design);
  call.input.jobs = usable_threads();
  call.input.bounds = schema::bounds_of(call.subject_to);
  Subject subject = choose_sheet(call.path, call.draw, call.design, call.criterion);
  if (call.keeps_card) {
    keep_card(subject,
              {.trials = call.input.trials, .jobs = call.input.jobs, .advice = Advice::none},
              call.input.bounds);
  }
  const ProvenBetter better = optimised(subject, call.input);
  if (!call.output.empty()) {
    schema::write_text_file(call.output, better_pattern(subject, better).dump(1) + "\n");
  }
  std::optional<Cards> cards;
  if (call.with_card) cards = cards_of(subject, better);
  if (call.json) {
    schema::Json json = study_json(subject, better);
    if (cards) {
      json["card_before"] = schema::card_json(cards->before);
      json["card_after"] = schema::card_json(cards->after);
    }
    return put_json(json);
  }
  const auto& shifts_mm = better.found.best().shifts_mm;
  put(optimise_text(subject, subject.model.sheet(shifts_mm, "the optimised sheet"), better));
  if (cards) put("\n" + cards_text(cards->before, cards->after));
}

// Adds the objective and the constraints.
void add_goal_and_limits(CLI::App& verb, OptimiseCall& call) {
  OptimiseInput& input = call.input;
  Names<std::string> goals;
  for (const std::string& goal : solver::goal_names()) goals.emplace_back(goal, goal);
  verb.add_option_function<std::string>(
          "--goal", [&input](const std::string& name) { input.goal = solver::goal_named(name); },
          fmt::format("objective to maximise, or of a shape to minimise [{}]", input.goal->name))
      ->check(one_of_words(goals, ""));
  verb.add_option("--subject-to", call.subject_to,
                  "constraint that every step keeps (may be repeated): \"stroke_max <= 0.06\", "
                  "\"largest_force_n <= 20\", or a goal as in \"miscut_margin_mm >= 0.1\" or "
                  "\"shape_max_mm <= 0.5\"")
      ->type_name("LIMIT");
  verb.add_flag("--keep-card", call.keeps_card,
                "requirements that the sheet's card meets are constraints, too: stress, margins, "
                "buckling, thickness, clearance of springs, yield");
  add_value(verb, "--deploys-from", input.deploys_from_deg,
            "pilot angle from which it must still deploy [the design's, the campaign's, or its D]",
            within("optimise", "deploys_from_deg"), "DEG");
  add_default(verb, "--least-slope", input.least_slope_mm_per_deg,
              "smallest slope of a diagonal with free shifts, mm/deg at 90 deg and times the sine "
              "elsewhere: against miscuts",
              within("optimise", "least_slope_mm_per_deg"), "MM_PER_DEG");
  add_default(verb, "--steps", input.most_steps, "largest number of steps",
              counted("optimise", "steps"), "N");
}

// Adds bounds of the springs, and the miscut copies.
void add_springs_and_copies(CLI::App& verb, OptimiseInput& input) {
  const auto add_range = [&](const char* name, std::vector<double>& range, const char* meaning) {
    verb.add_option(name, range, meaning)
        ->delimiter(',')
        ->expected(2)
        ->type_name("LEAST,MOST")
        ->excludes("--ternary");
  };
  add_range("--stiffness-within", input.stiffness_n_per_mm,
            "also optimise the spring rate within these bounds, N/mm, from the design's");
  add_range("--preload-within", input.preload_n,
            "also optimise the preload of all springs within these bounds, N");
  add_value(
      verb, "--rest-deg", input.rest_deg,
      "pilot angle where the springs are relaxed: a stop for rest_stiffness_n_mm_per_rad [the "
      "design's, or 0, flat]",
      within("optimise", "rest_deg"), "DEG");
  add_value(verb, "--miscut", input.miscut_mm,
            "cutting error of the copies of which a yield is counted, mm [the design's, or 0.05]",
            within("optimise", "miscut_mm"), "MM");
  add_default(verb, "--trials", input.trials, "number of copies", counted("optimise", "trials"),
              "N");
}

// Adds bounds of the shifts.
void add_shifts(CLI::App& verb, OptimiseInput& input) {
  add_value(
      verb, "--amplitude", input.amplitude_mm,
      "largest shift of a vertex in x or y, mm [the campaign's, or the largest of its shifts]",
      within("optimise", "amplitude_mm"), "MM");
  verb.add_flag("--rim", input.with_rim, "also shift the rim's vertices");
  verb.add_flag("--ternary", input.ternary, "shift by 0 or the amplitude only");
  add_value(verb, "--grid", input.grid_mm,
            "shift by whole multiples of this only, mm: a cutter's steps",
            within("optimise", "grid_mm"), "MM")
      ->excludes("--ternary");
  verb.add_flag("--within-family", input.within_family,
                "stay within the base's parallel family, which folds to 180 deg")
      ->excludes("--ternary")
      ->excludes("--grid");
}

}  // namespace

Action optimise_verb(CLI::App& verb) {
  verb.description(schema::study_named("optimise").about);
  verb.footer(
      "Ascends from the sheet by shifts that raise the objective, until no step does: without\n"
      "random numbers, so that the result is reproducible. Every step is folded, and must deploy\n"
      "from the requested angle within the amplitude, the design's stroke limit and its largest\n"
      "force. With --ternary a step sets one coordinate or two to 0 or the amplitude.\n"
      "Otherwise shifts are free, and active limits are shown with the gain of relaxing them.\n"
      "With --criterion energy the total energy of the springs has to fall to flat; diagonals\n"
      "need not be monotone.\n"
      "Goals of a shape, and their bounds, are for files with a \"target\", which `misalign "
      "shape`\n"
      "writes.\n"
      "The optimum depends on the start: try several candidates.\n"
      "Examples:\n  misalign optimise results/miura-6x6-1a2b3c4d.db 1234 --output better.json\n"
      "  misalign optimise search/patterns/table1.json --amplitude 1 --deploys-from 140\n"
      "  misalign optimise made.json --within-family --deploys-from 179\n"
      "  misalign optimise results/miura-6x6-1a2b3c4d.db 1234 --subject-to \"miscut_margin_mm >= "
      "0.1\"\n"
      "  misalign optimise search/patterns/table1.json --goal static_friction_n_mm_per_mm "
      "--thickness 2 --preload 0.1 --preload-within 0,3\n"
      "  misalign optimise search/patterns/table1.json --goal deploys_from_deg\n"
      "  misalign optimise dome.json --rim --goal rest_stiffness_n_mm_per_rad --subject-to "
      "\"shape_max_mm <= 0.5\"\n"
      "  misalign optimise search/patterns/table1.json --criterion energy --deploys-from 140");
  auto call = std::make_shared<OptimiseCall>();
  schema::Design& design = call->design;
  add_sheet(verb, *call);
  add_goal_and_limits(verb, *call);
  add_shifts(verb, call->input);
  add_springs_and_copies(verb, call->input);
  add_release_from(verb, design.from_deg, 0.01);
  add_springs(verb, design);
  add_criterion(verb, call->criterion);
  add_thickness(verb, design.thickness_mm);
  add_value(verb, "--friction", design.friction_n_mm_per_mm,
            "dry friction of creases, N mm/mm [the design's, or 0]",
            within("hinges.friction_n_mm_per_mm"), "N");
  add_material(verb, call->material);
  verb.add_option("--output", call->output, "write the sheet to this pattern file")
      ->type_name("FILE");
  verb.add_flag("--card", call->with_card, "also the cards of both sheets, side by side");
  verb.add_flag("--json", call->json, "as JSON, with the sheet as \"pattern\"");
  add_jobs(verb);
  return showing(call, show_optimised);
}

}  // namespace misalign::search
