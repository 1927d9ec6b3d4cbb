// Verbs that look at a pattern or a catalogue.
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <random>

#include "schema/catalogue/result_table.hpp"
#include "search/checks/chosen_sheet.hpp"
#include "search/checks/pattern_check.hpp"
#include "search/checks/verify.hpp"
#include "search/draws/nothing_found.hpp"
#include "search/terminal/status_text.hpp"
#include "search/terminal/suggestion.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/look.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {

using schema::Json;
using schema::UserError;

Action add_fold(CLI::App& app) {
  auto* verb = app.add_subcommand("fold", "the folding path of one pattern");
  verb->footer(
      "Each diagonal is drawn from flat to the end of the path, between its least and\n"
      "its largest length; a bar marks D, the angle that the sheet deploys from\n"
      "(an angle; the paper's D is a ratio).\n"
      "Lengths and elongations are those up to D, or up to the end if it does not\n"
      "deploy.\n"
      "An exported candidate, JSON or FOLD, is sampled as its campaign was; any other\n"
      "pattern at every degree to 180.\n\n"
      "Examples:\n"
      "  misalign fold search/patterns/table1.json\n"
      "  misalign fold search/patterns/table1.json --json > table1-folding.json");
  auto options = std::make_shared<FoldOptions>();
  verb->add_option("PATTERN", options->pattern_path,
                   "pattern file (JSON), exported candidate or FOLD file")
      ->required();
  verb->add_option("--to", options->to_deg, "last pilot angle, degrees [180, or the campaign's]")
      ->check(within(1, 180))
      ->type_name("DEG");
  verb->add_option("--step", options->step_deg, "look at multiples of this too, degrees")
      ->check(within(0.01, 180))
      ->type_name("DEG");
  verb->add_flag("--table", options->table,
                 "also the lengths every 10 degrees, where they are too wide for the terminal");
  verb->add_flag("--json", options->json, "as JSON");
  return [options] {
    fold(*options);
    return 0;
  };
}

Action add_perforations(CLI::App& app) {
  auto* verb = app.add_subcommand("perforations", "which holes leave one degree of freedom");
  verb->footer(
      "Lists every set of inner panels, no two sharing an edge, that counts to one\n"
      "degree of freedom and has one by the rank of the Jacobian. The pattern's own\n"
      "holes do not matter.\n\n"
      "Examples:\n  misalign perforations search/patterns/turned-quads-6x6.json");
  auto options = std::make_shared<PerforationsOptions>();
  verb->add_option("PATTERN", options->pattern_path, "pattern file (JSON)")->required();
  verb->add_flag("--json", options->json, "as JSON");
  return [options] {
    list_perforations(*options);
    return 0;
  };
}

Action add_status(CLI::App& app) {
  auto* verb = app.add_subcommand("status", "how far a campaign is, and what it found");
  verb->footer(
      "First faults, and survival in the JSON, are from the fault sample: each of its rows\n"
      "weighs the draws that it stands for. Where nothing was accepted, it says from which\n"
      "angle draws survive, how rare an accepted one is at most, and what to try.\n\n"
      "Examples:\n  misalign status results/miura-6x6-1a2b3c4d.db --at 160");
  auto path = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false), check = std::make_shared<bool>(false);
  auto at_deg = std::make_shared<std::optional<double>>();
  verb->add_option("CATALOGUE", *path, "catalogue file")->required();
  verb->add_flag("--json", *json, "as JSON");
  verb->add_flag("--check", *check, "exit with 75 while work remains, 0 when complete");
  verb->add_option("--at", *at_deg, "also count what deploys from this many degrees")
      ->type_name("DEG");
  return [=] {
    const auto database = schema::open_for_reading(*path);
    const schema::CatalogueState state = schema::read_state(*database);
    std::optional<DeployingFrom> deploying;
    if (*at_deg) {
      deploying =
          deploying_from(*database, state, schema::read_campaign_of(*database, *path), **at_deg);
    }
    const schema::Survival survival = schema::read_survival(*database);
    if (*json) {
      Json answer = status_json(state);
      answer["survival"] = survival_json(survival, state);
      if (deploying) answer["at"] = deploying_json(*deploying, state);
      put_json(answer);
    } else {
      put(status_text(state, deploying, paint_for(STDOUT_FILENO)));
      for (const std::string& sentence : nothing_found(survival, state)) {
        put("\n" + schema::printable(sentence) + "\n");
      }
      std::fflush(stdout);
      if (!*check) spdlog::info("next: {}", next_step(state, *path, ""));
    }
    return *check && !state.gaps.empty() ? schema::kExitWorkRemains : 0;
  };
}

Action add_replay(CLI::App& app) {
  auto* verb = app.add_subcommand("replay", "any draw of a campaign again, from its number");
  verb->footer("Examples:\n  misalign replay results/miura-6x6-1a2b3c4d.db 1234");
  auto options = std::make_shared<ReplayOptions>();
  verb->add_option("CATALOGUE", options->catalogue_path, "catalogue file")->required();
  verb->add_option("DRAW", options->draw, "number of the draw")->required()->check(a_draw());
  verb->add_flag("--table", options->table,
                 "also the lengths every 10 degrees, where they are too wide for the terminal");
  verb->add_flag("--json", options->json, "as JSON");
  return [options] {
    replay(*options);
    return 0;
  };
}

namespace {

bool is_one_word(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
  });
}

UserError no_such_query(const std::string& name) {
  // It went by the least slope, and foretold less than it said.
  const bool is_former = name == "robust";
  const std::string meant = is_former ? "tolerant" : nearest_word(name, schema::named_queries());
  return UserError(schema::kExitUsage, "the query was refused (" + name + " is the name of none" +
                                           (meant.empty() ? "" : "; did you mean " + meant + "?") +
                                           "); it must be one SELECT, or one of the names " +
                                           schema::named_query_list());
}

// Whether a named query's LIMIT left rows out: it is the last thing such a query says.
bool was_cut_off(SQLite::Database& database, const std::string& sql, std::uint64_t rows) {
  const std::size_t limit = sql.rfind("LIMIT ");
  if (limit == std::string::npos || std::stoull(sql.substr(limit + 6)) != rows) return false;
  const std::string next = "SELECT 1 FROM (" + sql.substr(0, limit) + ") LIMIT 1 OFFSET ";
  const std::string row =
      schema::query_table(database, next + std::to_string(rows), schema::TableStyle::csv);
  return std::count(row.begin(), row.end(), '\n') > 1;  // more than the header
}

// Instead of a header without rows, where a named query of candidates has none because there are
// none. False if there is nothing to say.
bool show_nothing_found(SQLite::Database& database, const std::string& sql) {
  if (sql.find("FROM candidate") == std::string::npos) return false;
  const std::vector<std::string> sentences = nothing_found(database, schema::read_state(database));
  for (const std::string& sentence : sentences) put(schema::printable(sentence) + "\n");
  std::fflush(stdout);
  return !sentences.empty();
}

void show_rows(SQLite::Database& database, const std::string& name, const std::string& sql,
               bool paged) {
  std::optional<Show> out;  // once there is something to show
  std::optional<std::string> header;
  const auto show_header = [&] {
    out.emplace(paged);
    return out->write(paint_for(STDOUT_FILENO).bold(*header) + "\n");
  };
  const std::uint64_t rows =
      schema::write_query(database, sql, schema::TableStyle::aligned, [&](const std::string& line) {
        if (header) return (out || show_header()) && out->write(line);
        header = line.substr(0, line.size() - 1);
        return true;
      });
  if (!out) {
    if (!name.empty() && show_nothing_found(database, sql)) return;
    show_header();
  }
  out.reset();
  std::fflush(stdout);
  if (!name.empty() && was_cut_off(database, sql, rows)) {
    spdlog::info(
        "the first {} rows; SQL of your own can ask for more, such as \"SELECT * FROM "
        "candidates\"",
        rows);
  }
}

}  // namespace

Action add_query(CLI::App& app) {
  auto* verb = app.add_subcommand("query", "a named query, or any read-only SQL");
  verb->footer("Named queries: " + schema::named_query_list() +
               ".\nElongations and strokes are shares of a length: stroke_max < 0.08 is 8 %.\n"
               "On a terminal the rows go through $PAGER [less].\n\n"
               "Examples:\n  misalign query results/miura-6x6-1a2b3c4d.db best\n"
               "  misalign query results/miura-6x6-1a2b3c4d.db --csv \\\n"
               "    \"SELECT draw FROM candidates WHERE stroke_max < 0.08\"");
  auto path = std::make_shared<std::string>(), sql = std::make_shared<std::string>("best");
  auto json = std::make_shared<bool>(false), csv = std::make_shared<bool>(false);
  auto unpaged = std::make_shared<bool>(false);
  verb->add_option("CATALOGUE", *path, "catalogue file")->required();
  verb->add_option("QUERY", *sql, "name or SQL [best]");
  auto* json_flag = verb->add_flag("--json", *json, "as JSON; a second column x is called x_2");
  verb->add_flag("--csv", *csv, "as CSV; on a terminal control characters are escaped")
      ->excludes(json_flag);
  verb->add_flag("--no-pager", *unpaged, "straight to the terminal");
  return [=] {
    const auto database = schema::open_for_reading(*path);
    const std::string named = schema::named_query(*sql);
    const std::string& text = named.empty() ? *sql : named;
    if (named.empty() && is_one_word(*sql)) throw no_such_query(*sql);
    if (!*json && !*csv) {
      show_rows(*database, named.empty() ? "" : *sql, text, !*unpaged);
    } else {
      const auto style = *json ? schema::TableStyle::json : schema::TableStyle::csv;
      schema::write_query(*database, text, style, [&](const std::string& piece) {
        *json ? put_json(piece) : put_csv(piece);
        return std::ferror(stdout) == 0;
      });
    }
    return 0;
  };
}

Action add_verify(CLI::App& app) {
  auto* verb = app.add_subcommand(
      "verify", "a catalogue's ledger and its candidates once more, or a pattern");
  verb->footer(
      "Checks the file, every unit's candidates and sums, what runs say of themselves,\n"
      "the goal's end, the diagonals and the digest, all of one moment; follows the\n"
      "chosen candidates' paths again from their stored displacements and compares\n"
      "every column; checks each folded shape by its coordinates; judges fault samples\n"
      "again. --units makes all draws of units chosen at random again: a candidate that\n"
      "was removed together with its sums is seen by nothing else. Panels that cross are\n"
      "reported (they are assumed not to), and no fault; so are metrics that an older\n"
      "build measured by another definition.\n"
      "A pattern file is one sheet: its path by two solvers, its folded shapes, and what\n"
      "an exported candidate says of itself.\n"
      "Exit code 6 if anything differs.\n\n"
      "Examples:\n  misalign verify results/miura-6x6-1a2b3c4d.db\n"
      "  misalign verify results/miura-6x6-1a2b3c4d.db --all --json\n"
      "  misalign verify results/miura-6x6-1a2b3c4d.db --units 20\n"
      "  misalign verify search/patterns/table1.json");
  auto path = std::make_shared<std::string>();
  auto options = std::make_shared<VerifyOptions>();
  auto sample = std::make_shared<std::uint64_t>(*options->sample);
  auto seed = std::make_shared<std::optional<std::uint64_t>>();
  auto all = std::make_shared<bool>(false), json = std::make_shared<bool>(false);
  add_catalogue_or_pattern(*verb, *path);
  auto* sample_option = verb->add_option("--sample", *sample,
                                         "so many candidates, spread evenly over them in the order "
                                         "of their draws, and as many fault samples [100]");
  sample_option->check(a_draw())->type_name("N");
  verb->add_flag("--all", *all, "every candidate and fault sample")->excludes(sample_option);
  auto* units_option =
      verb->add_option("--units", options->units,
                       "also make all draws of so many units again, chosen at random [0]");
  units_option->check(a_draw())->type_name("N");
  verb->add_option("--seed", *seed, "of that choice, to have the same again [a random one]")
      ->check(a_draw())
      ->needs(units_option)
      ->type_name("N");
  verb->add_flag("--json", *json, "as JSON");
  return [=] {
    if (is_pattern_file(*path)) {
      if (*all) throw only_of_a_catalogue(*path, "--all");
      if (sample_option->count() > 0) throw only_of_a_catalogue(*path, "--sample");
      if (units_option->count() > 0) throw only_of_a_catalogue(*path, "--units");
      const PatternVerification verification = verify_pattern(*path);
      *json ? put_json(pattern_verification_json(verification))
            : put(pattern_verification_text(verification));
      return verification.good() ? 0 : schema::kExitCheckFailed;
    }
    const auto database = schema::open_for_reading(*path);
    options->sample = *all ? std::nullopt : std::optional(*sample);
    options->seed = seed->value_or(std::random_device()());
    const Verification verification = verify(*database, *path, *options);
    *json ? put_json(verification_json(verification)) : put(verification_text(verification));
    return verification.good() ? 0 : schema::kExitCheckFailed;
  };
}

}  // namespace misalign::search
