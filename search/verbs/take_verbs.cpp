// Verbs that size a candidate's springs and take candidates away.
#include <cstdio>

#include "schema/campaign/campaign.hpp"
#include "schema/exchange/plain_export.hpp"
#include "search/checks/chosen_sheet.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/actuators.hpp"
#include "search/verbs/choice_options.hpp"
#include "search/verbs/export.hpp"
#include "search/verbs/report.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

void add_other_actuators(CLI::App& verb, OtherActuators& actuators) {
  verb.add_option("--stiffness", actuators.stiffness_n_per_mm,
                  "of each spring, N/mm [the campaign's]")
      ->check(within(schema::kLeastStiffness_n_per_mm, schema::kMostStiffness_n_per_mm))
      ->type_name("N/MM");
  verb.add_option("--stroke-limit", actuators.stroke_limit,
                  "largest elongation of an actuator: 0.08, 8 %, for Ti-Ni wires [the campaign's]")
      ->check(a_share(schema::kLeastStroke, schema::kMostStroke))
      ->type_name("SHARE");
}

// --draw, as often as there are draws.
CLI::Option* add_draws(CLI::App& group, std::vector<std::uint64_t>& draws,
                       const std::string& what) {
  return group.add_option("--draw", draws, what + " (again: and that one)")
      ->check(a_draw())
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("N");
}

// The first option of a group that was given; empty if none was.
std::string first_given(const CLI::App& group) {
  for (const CLI::Option* option : group.get_options()) {
    if (option->count() > 0) return option->get_name();
  }
  return "";
}

int run_export(const ExportOptions& options, bool compat, const CLI::App& verb,
               const CLI::App& choice) {
  const auto only_with = [&](const char* option, bool has_sense, const char* with) {
    if (verb.count(option) == 0 || has_sense) return;
    throw schema::UserError(schema::kExitUsage, std::string(option) + " has no meaning without " +
                                                    with + "; take it out, or add that");
  };
  const bool in_states =
      options.format == ExportFormat::fold || options.format == ExportFormat::obj;
  only_with("--step", in_states, "--format fold or obj");
  only_with("--creases", options.format == ExportFormat::csv, "--format csv");
  const std::string chosen_by = first_given(choice);
  if (is_pattern_file(options.path)) {
    if (!chosen_by.empty()) throw only_of_a_catalogue(options.path, chosen_by);
    export_pattern(options);
  } else if (chosen_by.empty()) {
    throw schema::UserError(schema::kExitUsage,
                            options.path +
                                ": nothing is chosen of it (a catalogue holds many); say --best, "
                                "--draw, --where, --diverse or --sqlite-compat");
  } else if (compat) {
    schema::export_plain(*schema::open_for_reading(options.path), options.output);
    put(schema::printable(options.output) + "\n");
  } else {
    check_by(options.choice);
    export_candidates(options);
  }
  return 0;
}

}  // namespace

void add_catalogue_or_pattern(CLI::App& verb, std::string& path) {
  verb.add_option("FILE", path, "catalogue, or a pattern: JSON, exported candidate or FOLD file")
      ->required();
}

void add_draw_of_catalogue(CLI::App& verb, std::optional<std::uint64_t>& draw) {
  verb.add_option("DRAW", draw, "number of the draw, of a catalogue")->check(a_draw());
}

Action add_actuators(CLI::App& app) {
  auto* verb = app.add_subcommand("actuators", "springs on the diagonals of one sheet");
  verb->footer(
      "Energy, moment about the pilot crease (dE/d pilot angle; negative: the springs\n"
      "would fold the sheet further) and mechanical advantage (newtons on the sheet's\n"
      "span for each newton in every diagonal) along the way, the force on each\n"
      "diagonal, where the moment is least, and the fewest diagonals that keep half of\n"
      "that. deployment: (180 - pilot)/180, 1 when flat. Forces and elongations are\n"
      "positive where a spring is longer than when flat, and pulls.\n\n"
      "Examples:\n  misalign actuators results/miura-6x6-1a2b3c4d.db 1234\n"
      "  misalign actuators results/miura-6x6-1a2b3c4d.db 1234 --stroke-limit 0.08\n"
      "  misalign actuators search/patterns/table1.json");
  auto options = std::make_shared<ActuatorsOptions>();
  add_catalogue_or_pattern(*verb, options->path);
  add_draw_of_catalogue(*verb, options->draw);
  add_other_actuators(*verb, options->actuators);
  verb->add_flag("--json", options->json, "as JSON, with all histories");
  return [options] {
    show_actuators(*options);
    return 0;
  };
}

Action add_export(CLI::App& app) {
  auto* verb = app.add_subcommand("export", "chosen candidates, or a pattern, as files");
  verb->footer(
      "Formats: json (pattern, verdict, metrics, springs), csv (one long table, below),\n"
      "fold (crease pattern and folded states, for Origami Simulator and the like), svg\n"
      "(true scale, layers for a cutter, hidden ones for springs and labels), obj (one\n"
      "file per state). Where two holes meet, the panels between them touch in a\n"
      "point: a ball joint that the drawing does not make. Files are named after the\n"
      "campaign and the draw, or after the pattern file.\n"
      "csv: a row for each draw, degree and diagonal, all draws in one file: length,\n"
      "elongation (a share: 0.02 = 2 %), its spring's force, energy and moment (they add\n"
      "up to the sheet's), and the sheet's mechanical advantage. Diagonals are numbered\n"
      "from 0, as in the view diagonals. --creases adds a second table, of fold angles.\n\n"
      "Examples:\n  misalign export results/miura-6x6-1a2b3c4d.db --best 3 --output out\n"
      "  misalign export results/miura-6x6-1a2b3c4d.db --draw 1234 --format svg --output out\n"
      "  misalign export results/miura-6x6-1a2b3c4d.db --diverse 5 \\\n"
      "    --where \"stroke_max < 0.08\" --format fold --step 5 --output out\n"
      "  misalign export results/miura-6x6-1a2b3c4d.db --best 1000 --format csv --output out\n"
      "  misalign export search/patterns/table1.json --format svg --output out\n"
      "  misalign export results/miura-6x6-1a2b3c4d.db --sqlite-compat --output plain.db");
  auto options = std::make_shared<ExportOptions>();
  Choice& choice = options->choice;
  add_catalogue_or_pattern(*verb, options->path);
  auto* group = verb->add_option_group("choice", "which candidates of a catalogue");
  auto* draw = add_draws(*group, choice.draws, "this one");
  const ChoiceOptions chosen = add_choice(*verb, *group, choice);
  auto compat = std::make_shared<bool>(false);
  auto* plain =
      group->add_flag("--sqlite-compat", *compat,
                      "the whole catalogue, as one file that SQLite from 3.8 (2014) on can read");
  for (CLI::Option* other : {chosen.best, chosen.diverse, chosen.where}) {
    draw->excludes(other);
    plain->excludes(other);
  }
  draw->excludes(plain);
  verb->add_option("--format", options->format, "json, csv, fold, svg or obj [json]")
      ->transform(one_of({{"json", number_of(ExportFormat::json)},
                          {"csv", number_of(ExportFormat::csv)},
                          {"fold", number_of(ExportFormat::fold)},
                          {"svg", number_of(ExportFormat::svg)},
                          {"obj", number_of(ExportFormat::obj)}}));
  verb->add_option("--step", options->step_deg,
                   "degrees of the pilot between two states of fold and obj [10]")
      ->check(within(0.01, 180))
      ->type_name("DEG");
  verb->add_flag("--creases", options->creases, "with csv: also NAME-creases.csv, of fold angles");
  add_other_actuators(*verb, options->actuators);
  verb->add_option("--output", options->output,
                   "directory, made if it is not there; with --sqlite-compat a new file")
      ->required()
      ->type_name("PATH");
  return [options, compat, verb, group] { return run_export(*options, *compat, *verb, *group); };
}

Action add_report(CLI::App& app) {
  auto* verb = app.add_subcommand("report", "one page to look at, complete in itself");
  verb->footer(
      "The page needs no network. Its table holds the best candidates; 36 of them, the\n"
      "best ones or those that are chosen, and the draws that are asked for, can be\n"
      "looked at: crease pattern, folding, histories, springs. The page of a pattern file\n"
      "shows that one sheet.\n\n"
      "Examples:\n  misalign report results/miura-6x6-1a2b3c4d.db --output report.html\n"
      "  misalign report results/miura-6x6-1a2b3c4d.db --draw 1234 --output report.html\n"
      "  misalign report results/miura-6x6-1a2b3c4d.db --diverse 12 \\\n"
      "    --where \"stroke_max < 0.08\" --output report.html\n"
      "  misalign report search/patterns/table1.json --output table1.html");
  auto options = std::make_shared<ReportOptions>();
  add_catalogue_or_pattern(*verb, options->path);
  verb->add_option("--output", options->output, "HTML file to write")
      ->required()
      ->type_name("FILE");
  add_draws(*verb, options->draws, "a draw to look at, accepted or not");
  verb->add_option("--rows", options->rows, "at most so many candidates in the table [10000]")
      ->check(counted(0, 1000000))
      ->type_name("N");
  auto* details =
      verb->add_option("--details", options->details,
                       "so many of the best can be looked at; of those of --where too [36]")
          ->check(counted(0, kMostDetails))
          ->type_name("N");
  auto* group = verb->add_option_group("choice", "which candidates can be looked at");
  const ChoiceOptions chosen = add_choice(*verb, *group, options->choice);
  for (CLI::Option* many : {chosen.best, chosen.diverse}) {
    many->check(counted(1, kMostDetails))->excludes(details);
  }
  add_other_actuators(*verb, options->actuators);
  return [options, verb, group] {
    if (is_pattern_file(options->path)) {
      std::string chosen_by = first_given(*group);
      for (const char* option : {"--draw", "--rows", "--details", "--by"}) {
        if (verb->count(option) > 0) chosen_by = option;
      }
      if (!chosen_by.empty()) throw only_of_a_catalogue(options->path, chosen_by);
      write_report_of_pattern(*options);
      return 0;
    }
    if (options->choice.where.empty()) check_by(options->choice);
    write_report(*options);
    return 0;
  };
}

}  // namespace misalign::search
