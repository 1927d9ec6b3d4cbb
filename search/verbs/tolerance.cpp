// `misalign tolerance`: the share of miscut copies of a sheet that deploy, or of trials with play
// in its joints in which it is monotone.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/recovery.hpp"
#include "schema/catalogue/study_table.hpp"
#include "schema/exchange/tolerance_json.hpp"
#include "schema/pattern/fill_json.hpp"
#include "schema/pattern/perforation_check.hpp"
#include "search/ranks/run_info.hpp"
#include "search/sheets/joint_of_design.hpp"
#include "search/sheets/tolerance_text.hpp"
#include "search/terminal/build_info.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/rank_options.hpp"
#include "search/verbs/tolerance_call.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

using schema::Json;
using schema::UserError;

// Keeps the yields; returns why they are not in the catalogue, or nothing.
std::string keep(const ToleranceCall& call, const schema::Campaign& campaign,
                 const std::vector<schema::Yield>& yields) {
  const solver::PerforatedSheet& base = campaign.pattern.base;
  try {
    schema::Catalogue catalogue(call.path, campaign, solver::build_mechanism(base), {},
                                schema::Missing::refused);
    const std::vector<std::uint64_t> gone = catalogue.keep(yields, build_info().commit);
    catalogue.close();
    if (gone.empty()) return "";
    return call.path + ": " + std::to_string(gone.size()) + " of " + std::to_string(yields.size()) +
           " candidates are not in it any more, draw " + std::to_string(gone.front()) +
           " among them (another catalogue took its place); put the former one back, then the same "
           "command again";
  } catch (const UserError& error) {
    return error.sentence(option_of);
  }
}

// The yield from the campaign's threshold, or from the angle of use.
schema::Yield yield_of(std::uint64_t draw, const solver::Tolerance& tolerance,
                       double threshold_deg) {
  schema::Yield yield{draw,
                      tolerance.amplitude_mm,
                      tolerance.copies.trials,
                      tolerance.survivors(),
                      tolerance.copies.undecided,
                      {}};
  if (tolerance.threshold_deg != threshold_deg) yield.from_deg = tolerance.threshold_deg;
  return yield;
}

void print(const ToleranceCall& call, const ToleranceTargets& sheets,
           const std::vector<solver::Tolerance>& tolerances) {
  const bool single = is_single(call, sheets);
  std::string text;
  if (call.json) {
    Json list = Json::array();
    for (std::size_t k = 0; k < tolerances.size(); ++k) {
      list.push_back(schema::tolerance_json(tolerances[k]));
      list.back().update(sheets.key(k).json());
    }
    text = (single ? list.front() : list).dump(1) + "\n";
  } else {
    std::vector<NamedTolerance> named;
    for (std::size_t k = 0; k < tolerances.size(); ++k) {
      named.push_back({sheets.key(k).name(), tolerances[k]});
    }
    if (named.size() > 1 && call.study.vertices) {
      for (const NamedTolerance& each : named) text += tolerance_text(each) + "\n";
    }
    text += named.size() == 1 ? tolerance_text(named.front()) : tolerances_text(named);
  }
  call.json ? put_json(text) : put(text);
}

void run_miscuts(ToleranceCall& call, const ToleranceTargets& sheets) {
  call.study.amplitude_mm = *call.amplitude_mm;
  for (std::size_t k = 0; k < sheets.shifts_mm.size(); ++k) {
    check_miscut(call.study.amplitude_mm, sheets.campaign.pattern.base.sheet, sheets.shifts_mm[k],
                 sheets.key(k).name());
  }
  call.study.progress = show_copies;
  call.study.filled = filled_by(sheets.design, sheets.campaign.pattern.base);
  const schema::Campaign used = campaign_of_use(call, sheets);
  const std::vector<solver::Tolerance> tolerances =
      study_tolerance(used, sheets.shifts_mm, call.study);
  if (call.keep && !sheets.draws.empty()) {
    std::vector<schema::Yield> yields;
    for (std::size_t k = 0; k < tolerances.size(); ++k) {
      yields.push_back(yield_of(sheets.draws[k], tolerances[k], sheets.campaign.threshold_deg));
    }
    const std::string why_not = keep(call, sheets.campaign, yields);
    if (!why_not.empty()) spdlog::warn("this is not kept in the catalogue: {}", why_not);
  }
  print(call, sheets, tolerances);
}

// Takes the typed error, or else the design's: miscuts before play.
void take_subject(const ToleranceTargets& sheets, ToleranceCall& call) {
  if (!call.amplitude_mm && !call.backlash_mm) {
    call.amplitude_mm = call.design.joint_kind ? std::nullopt : sheets.design.miscut_mm;
    if (!call.amplitude_mm) {
      call.backlash_mm = play_of(sheets.design, sheets.campaign, sheets.shifts_mm);
    }
  }
  if (!call.amplitude_mm && !call.backlash_mm) {
    throw UserError(
        schema::Cause::bad_request,
        "tolerance: no error is named (the design has neither miscut_mm, play_mm nor "
        "joints); add --amplitude MM for cutting errors, or --backlash MM for joints with play");
  }
  if (call.backlash_mm) check_backlash(call);
}

int run(ToleranceCall call) {
  call.study.set = solver::available_instruction_sets().back();
  call.study.jobs = usable_threads();
  std::optional<ChosenSheet> file;
  if (is_pattern_file(call.path)) file = sheet_of_pattern_file(call.path);
  if (!file && call.keep) schema::recover_before_writing(call.path);
  // Closes the catalogue again, before the writer's lock: see WriterLock.
  ToleranceTargets sheets = file ? chosen_sheet(call, *file) : choose_sheets(call);
  sheets.design = call.design.merged_over(std::move(sheets.design));
  schema::check_fill(sheets.design, sheets.campaign.pattern.base);
  take_subject(sheets, call);
  if (schema::is_overconstrained(sheets.campaign.pattern.base)) {
    run_gaps(call, sheets);
  } else if (call.backlash_mm) {
    run_backlash(call, sheets);
  } else {
    run_miscuts(call, sheets);
  }
  return 0;
}

void add_subject(CLI::App& verb, ToleranceCall& call) {
  auto* amplitude = add_value(verb, "--amplitude", call.amplitude_mm,
                              "largest cutting error of a vertex, mm [the design's miscut_mm]",
                              within("miscut_mm"), "MM");
  auto* vertices =
      verb.add_flag("--vertices", call.study.vertices,
                    "also move each vertex alone, in " + std::to_string(kMostTrialsOfOneVertex) +
                        " copies at most, and rank them by harm");
  auto* backlash = add_value(verb, "--backlash", call.backlash_mm,
                             "radius of the ball in which each joint settles, mm, instead of "
                             "miscuts [the design's play_mm, if it has no miscut_mm]",
                             within("play_mm"), "MM")
                       ->excludes(amplitude)
                       ->excludes(vertices);
  add_joints(verb, call.design)->excludes(amplitude)->excludes(backlash);
  add_rest(verb, call.design.rest_deg);
  add_fill(verb, call.design);
  add_value(verb, "--friction", call.design.friction_n_mm_per_mm,
            "dry friction of creases, N mm/mm: where it holds copies round their stops",
            within("hinges.friction_n_mm_per_mm"), "N")
      ->excludes(backlash);
  add_value(verb, "--backlash-from", call.backlash.from_deg,
            fmt::format("pilot angle above which a loose sheet must be monotone, degrees [{:g}]",
                        solver::BacklashOptions{}.from_deg),
            within(0.1, 180), "DEG")
      ->needs(backlash);
}

}  // namespace

Action tolerance_verb(CLI::App& verb) {
  verb.description(schema::study_named("tolerance").about);
  verb.footer(
      "Every vertex, also on the perimeter, is moved by a random error, uniform on [-MM, MM]\n"
      "in x and in y. Trial t makes the same errors for every candidate of a campaign: they\n"
      "follow from the campaign's seed and t. Confidence intervals are exact ones of 95 %.\n"
      "  of a candidate   a copy deploys if it reaches --from. The yield is kept in the catalogue\n"
      "                   unless one from as many trials or more with this amplitude and from\n"
      "                   this angle is there: see `misalign query FILE yields`, and, of the\n"
      "                   campaign's threshold, column yield of `export --by` and `--where`\n"
      "  of a pattern     (a file, or an exported candidate) a copy deploys if it reaches\n"
      "                   --from; the errors are those of seed 1; nothing is kept\n"
      "`misalign query FILE tolerant` lists the candidates that miscuts should harm least.\n\n"
      "Miscut copies of an overconstrained pattern, with fewer holes than one degree of freedom\n"
      "needs, do not fold. Of those the gaps of their joints are shown, which play or bending\n"
      "panels must close. Panels are placed by least squares of all gaps.\n\n"
      "A design, or --rest-deg, whose springs or plates are relaxed half open makes a stop. Those\n"
      "of a copy are made for the sheet itself: shown is where copies stop that are let go at\n"
      "--from and move slowly; with friction the range of angles in which it holds them, and\n"
      "where they stop is its upper end; and their distances there from the pattern's target.\n\n"
      "With --backlash the sheet is cut well and its joints have play: in each trial both ends of\n"
      "every hinge and every ball joint are off by a point in a ball of that radius, and stay so.\n"
      "The result is the share of trials in which every diagonal is monotone from --backlash-from\n"
      "up to D, and the largest backlash with which 95 % are, by the same trials. Flat is no\n"
      "state of a loose sheet: the angle where the way down is lost is shown, and where a sheet\n"
      "with a stop stops. Nothing is kept.\n"
      "Examples:\n"
      "  misalign tolerance results/miura-6x6-1a2b3c4d.db 1234 --amplitude 0.05 --vertices\n"
      "  misalign tolerance results/miura-6x6-1a2b3c4d.db --best 50 --by miscut_margin_mm \\\n"
      "    --amplitude 0.05\n"
      "  misalign tolerance search/patterns/table1.json --amplitude 0.05 --from 140\n"
      "  misalign tolerance search/patterns/table1.json --backlash 0.01 --backlash-from 30");
  auto call = std::make_shared<ToleranceCall>();
  ToleranceOptions& study = call->study;
  add_catalogue_or_pattern(verb, call->path);
  auto* draws =
      verb.add_option("DRAW", call->choice.draws, "draw numbers of candidates of a catalogue")
          ->check(a_draw());
  auto* group = verb.add_option_group("choice", "which candidates of a catalogue, instead of DRAW");
  const ChoiceOptions chosen = add_choice(verb, *group, call->choice);
  for (CLI::Option* other : {chosen.best, chosen.diverse, chosen.where}) draws->excludes(other);
  add_subject(verb, *call);
  add_from(verb, call->from_deg, "[the design's, or the campaign's threshold, or a pattern's D]");
  add_value(verb, "--trials", study.trials,
            "number of copies, or of settlings of the joints [1000]",
            counted("tolerance", "trials"), "N");
  add_jobs(verb);
  verb.add_flag("!--no-keep", call->keep, "do not write the yields into the catalogue");
  verb.add_flag("--json", call->json, "as JSON: a list, unless one DRAW is named, or a pattern");
  return [call, draws, chosen] {
    if (is_pattern_file(call->path)) {
      for (const CLI::Option* option :
           {draws, chosen.best, chosen.diverse, chosen.where, chosen.by}) {
        if (option->count() == 0) continue;
        throw only_of_a_catalogue(call->path, option == draws ? "a draw" : option->get_name());
      }
    }
    check_by(call->choice);
    return run(*call);
  };
}

}  // namespace misalign::search
