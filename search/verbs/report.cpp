// `misalign report`: one page about a catalogue, or a pattern.
#include "schema/report/report.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/files/text_file.hpp"
#include "search/checks/campaign_sheet.hpp"
#include "search/checks/chosen_sheet.hpp"
#include "search/checks/deployment_functions.hpp"
#include "search/checks/report_details.hpp"
#include "search/ranks/build_info.hpp"
#include "search/terminal/ladder_text.hpp"
#include "search/terminal/shell_word.hpp"
#include "search/terminal/status_text.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/choice_options.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

// A draw to look at makes some 0.1 MB of the page, on a large sheet 0.4 MB.
constexpr std::uint64_t kMostDetails = 1000;

struct ReportCall {
  std::string path;  // a catalogue or a pattern file
  std::string output;
  std::vector<std::uint64_t> draws;  // to look at, beside the best; any draws of the campaign
  std::uint64_t rows = 10000;        // at most so many candidates in the table
  std::uint64_t details = 36;        // so many of the best ones can be looked at
  Choice choice;                     // whom to look at instead; of `where` alone, `details` many
  OtherActuators actuators;
  bool let_go = false;  // the table says what comes of letting each go
  ReportWish wish;
};

using schema::Json;

// Details may take about so much of the page; large sheets get fewer of them.
constexpr std::size_t kMostDetailBytes = 24 << 20;

std::string now() {
  const auto time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%FT%TZ}", fmt::gmtime(time));
}

std::vector<std::uint64_t> first_in_table(const Json& candidates, std::uint64_t most) {
  std::vector<std::uint64_t> draws;
  for (const Json& draw : candidates["columns"].value("draw", Json::array())) {
    if (draws.size() >= most) break;
    draws.push_back(std::stoull(draw.get<std::string>()));
  }
  return draws;
}

// Whose folding the page carries, none twice; the first `asked_for` whatever it takes.
struct DrawsToLookAt {
  std::vector<std::uint64_t> draws;
  std::size_t asked_for = 0;

  void add(const std::vector<std::uint64_t>& more) {
    for (const std::uint64_t draw : more) {
      if (std::find(draws.begin(), draws.end(), draw) == draws.end()) draws.push_back(draw);
    }
  }
};

DrawsToLookAt draws_to_look_at(SQLite::Database& database, const Json& candidates,
                               const ReportCall& call) {
  DrawsToLookAt look;
  look.add(call.draws);
  look.asked_for = look.draws.size();
  Choice choice = call.choice;
  const bool counted = choice.best || choice.diverse;
  if (!choice.chooses()) {
    look.add(first_in_table(candidates, call.details));
  } else if (call.details > 0 && (candidates["total"] > 0 || !choice.where.empty())) {
    if (!counted) choice.best = call.details;
    look.add(chosen_draws(database, choice));
  }
  if (counted) look.asked_for = look.draws.size();
  return look;
}

Json details_json(SQLite::Database& database, const schema::Campaign& campaign,
                  const SheetFolder& folder, const DrawsToLookAt& look, ReportDetails& details) {
  Json json = Json::array();
  std::size_t bytes = 0;
  for (std::size_t k = 0; k < look.draws.size(); ++k) {
    if (k >= look.asked_for && bytes >= kMostDetailBytes) break;
    const std::uint64_t draw = look.draws[k];
    const FoldedSheet folded = folder.fold(shifts_of_number(database, campaign, draw));
    const bool accepted = campaign.accepts(folded.path.history.verdict);
    json.push_back(details.of_draw(folded, draw, accepted));
    bytes += json.back().dump().size();
  }
  return json;
}

Json diagonals_json(const schema::Pattern& pattern, const solver::Mechanism& mechanism) {
  Json diagonals = Json::array();
  for (const solver::Diagonal& diagonal : mechanism.diagonals) {
    diagonals.push_back({{"diagonal", diagonals.size()},
                         {"hole", schema::facet_json(pattern, mechanism.loops[diagonal.loop].hole)},
                         {"from", solver::vertex_label(diagonal.from)},
                         {"to", solver::vertex_label(diagonal.to)},
                         {"from_vertex", diagonal.from},
                         {"to_vertex", diagonal.to}});
  }
  return diagonals;
}

// The options that were given, for the page's commands.
std::string options_of(const OtherActuators& actuators) {
  std::string text;
  if (const auto& k = actuators.stiffness_n_per_mm)
    text += " --stiffness " + schema::shown_number(*k);
  if (const auto& limit = actuators.stroke_limit) {
    text += " --stroke-limit " + schema::shown_number(*limit);
  }
  return text;
}

// Whom the page shows, in its own words' terms.
Json chosen_json(const ReportCall& call) {
  const Choice& choice = call.choice;
  return {{"draws", call.draws.size()},
          {"best", choice.best ? Json(*choice.best) : Json()},
          {"diverse", choice.diverse ? Json(*choice.diverse) : Json()},
          {"where", choice.where.empty() ? Json() : Json(choice.where)},
          {"by", choice.by ? Json(*choice.by) : Json()}};
}

// What the page's commands are made of: it shows how to go on from what it shows.
Json commands_json(const ReportCall& call) {
  std::string choice = text_of(call.choice);
  if (call.details != ReportCall().details) {
    choice += " --details " + std::to_string(call.details);
  }
  if (call.rows != ReportCall().rows) choice += " --rows " + std::to_string(call.rows);
  if (call.wish.contact) choice += " --contact";
  return {{"misalign", "misalign"},
          {"catalogue", shell_word(call.path)},
          {"choice", choice},
          {"springs", options_of(call.actuators)},
          {"output", shell_word(call.output)}};
}

// The state as `status --json` has it; of a splitting search also why its rate is not to be
// believed yet, in the words of `status`, and what its numbers are made of.
Json state_json(const schema::CatalogueState& state) {
  Json json = status_json(state);
  if (!state.ladder) return json;
  const schema::SplitRate* const rate = state.ladder->rate();
  json["ladder"].update(
      {{"why_not_converged", rate ? why_not_converged(*rate) : ""},
       {"without_end", state.goal_end / schema::kNumbersOfPopulation >= schema::kEndOfPopulations},
       {"numbers_of_population", schema::kNumbersOfPopulation}});
  return json;
}

// What the catalogue says, all of it of one moment: a search may be writing.
Json catalogue_json(SQLite::Database& database, const schema::Campaign& campaign,
                    const ReportCall& call, DrawsToLookAt& look) {
  return schema::reading(database, [&] {
    const SQLite::Transaction moment(database);
    Json json = {{"state", state_json(schema::read_state(database))},
                 {"faults", schema::faults_json(database, campaign)},
                 {"candidates", schema::candidates_json(database, call.rows, call.let_go)}};
    look = draws_to_look_at(database, json["candidates"], call);
    json["yields"] = schema::report_yields_json(database, call.rows, look.draws);
    json["certificates"] = schema::report_certificates_json(database, call.rows, look.draws);
    return json;
  });
}

// What is folded, and by what.
Json folding_json(const SheetFolder& folder) {
  const auto& limit = folder.actuators().stroke_limit;
  return {{"sheet", schema::sheet_json(folder.base(), folder.mechanism())},
          {"diagonals", diagonals_json(folder.base(), folder.mechanism())},
          {"actuators",
           {{"stiffness_n_per_mm", folder.actuators().stiffness_n_per_mm},
            {"stroke_limit", limit ? Json(*limit) : Json()}}}};
}

// Who wrote the page, of what, and how it can be written again.
Json origin_json(const ReportCall& call) {
  return {{"format", 1},
          {"program", {{"version", build_info().version}, {"commit", build_info().commit}}},
          {"written_at", now()},
          {"catalogue", call.path},
          {"chosen", chosen_json(call)},
          {"commands", commands_json(call)}};
}

void refuse_own_input(const ReportCall& call) {
  std::vector<std::string> read = call.wish.stress_files;
  read.push_back(call.path);
  for (const std::string& path : read) {
    std::error_code error;
    if (!std::filesystem::equivalent(call.output, path, error)) continue;
    throw schema::UserError(
        schema::kExitUsage,
        "--output " + call.output + ": is the file itself that is shown; name another file");
  }
}

// Those of a result of `misalign stress` are looked at whatever room they take, and are to be among
// those that are shown.
void settle_stress(const ReportCall& call, const std::vector<std::uint64_t>& stressed,
                   DrawsToLookAt& look) {
  for (std::size_t k = 0; k < stressed.size(); ++k) {
    const auto at = std::find(look.draws.begin(), look.draws.end(), stressed[k]);
    if (at == look.draws.end()) {
      throw schema::UserError(
          schema::kExitBadInput,
          fmt::format(
              "{}: is of draw {}, which is not among those that can be looked at closely on "
              "this page; add --draw {}",
              call.wish.stress_files[k], stressed[k], stressed[k]));
    }
    look.asked_for =
        std::max(look.asked_for, static_cast<std::size_t>(at - look.draws.begin()) + 1);
  }
}

void write_page(const ReportCall& call, const Json& data) {
  schema::write_text_file(call.output, schema::report_page(data));
  put(schema::printable(call.output) + "\n");
}

void write_report(const ReportCall& call) {
  refuse_own_input(call);
  const auto database = schema::open_for_reading(call.path);
  add_deployment_functions(*database, call.path, call.actuators.stiffness_n_per_mm);
  schema::Campaign campaign = schema::read_campaign_of(*database, call.path);
  campaign.actuators = call.actuators.instead_of(campaign.actuators);
  const SheetFolder folder(campaign);
  ReportDetails details(folder, call.wish);
  const std::vector<std::uint64_t> stressed = details.draws_with_stress(campaign);
  DrawsToLookAt look;
  const Json catalogue = catalogue_json(*database, campaign, call, look);
  settle_stress(call, stressed, look);
  Json data = origin_json(call);
  data["campaign"] = {{"name", campaign.name},
                      {"identity", schema::identity(campaign)},
                      {"configuration", schema::campaign_json(campaign)}};
  data.update(catalogue);
  data.update(folding_json(folder));
  data["details"] = details_json(*database, campaign, folder, look, details);
  write_page(call, data);
}

void write_report_of_pattern(const ReportCall& call) {
  refuse_own_input(call);
  const ChosenSheet sheet = sheet_of_pattern_file(call.path);
  const SheetFolder folder(sheet.base, sheet.sampling, call.actuators.instead_of(sheet.actuators));
  ReportDetails details(folder, call.wish);
  details.check_stress(call.path, sheet.whose()["sheet"]);
  Json data = origin_json(call);
  data["pattern"] = {{"name", sheet.pattern}, {"sampling", schema::sampling_json(sheet.sampling)}};
  data["candidates"] = {{"total", 0}, {"shown", 0}, {"columns", Json::object()}};
  data.update(folding_json(folder));
  data["details"] = Json::array({details.of_pattern(folder.fold(sheet.shifts_mm), sheet.pattern)});
  write_page(call, data);
}

}  // namespace

Action report_verb(CLI::App& verb) {
  verb.description("one page to look at, complete in itself");
  verb.footer(
      "The page needs no network. Its table holds the best candidates. Some of them can be\n"
      "looked at closely (crease pattern, folding, histories, springs): the 36 best, or those\n"
      "that you choose, and every --draw. The page of a pattern file shows that one sheet.\n\n"
      "Examples:\n  misalign report results/miura-6x6-1a2b3c4d.db --output report.html\n"
      "  misalign report results/miura-6x6-1a2b3c4d.db --draw 1234 --output report.html\n"
      "  misalign report results/miura-6x6-1a2b3c4d.db --diverse 12 \\\n"
      "    --where \"stroke_max < 0.08\" --output report.html\n"
      "  misalign report results/miura-6x6-1a2b3c4d.db --draw 1234 --contact \\\n"
      "    --stress stress/miura-6x6-1234-stress.json --output report.html\n"
      "  misalign report search/patterns/table1.json --output table1.html");
  auto call = std::make_shared<ReportCall>();
  add_catalogue_or_pattern(verb, call->path);
  verb.add_option("--output", call->output, "HTML file to write")->required()->type_name("FILE");
  add_draws(verb, call->draws,
            "also this draw, accepted or not; of a splitting search only a stored one");
  verb.add_option("--rows", call->rows, "how many candidates the table may hold [10000]")
      ->check(counted(0, 1000000))
      ->type_name("N");
  auto* details =
      verb.add_option("--details", call->details,
                      "how many of the best, or of those of --where, can be looked at closely [36]")
          ->check(counted(0, kMostDetails))
          ->type_name("N");
  auto* group = verb.add_option_group("choice", "which candidates can be looked at closely");
  const ChoiceOptions chosen = add_choice(verb, *group, call->choice);
  for (CLI::Option* many : {chosen.best, chosen.diverse}) {
    many->check(counted(1, kMostDetails))->excludes(details);
  }
  add_other_actuators(verb, call->actuators);
  verb.add_flag(
      "--deploy", call->let_go,
      "in the table also when candidates that are let go are flat, and what friction they "
      "overcome (some milliseconds each)");
  verb.add_flag(
      "--contact", call->wish.contact,
      "also where panels first meet, of each sheet that can be looked at closely (about a "
      "tenth of a second each)");
  verb.add_option("--stress", call->wish.stress_files,
                  "NAME-stress.json that `misalign stress` wrote of a sheet that can be looked at "
                  "closely: colours its panels (again: and that one)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("FILE");
  return [call, &verb, group] {
    if (is_pattern_file(call->path)) {
      std::string chosen_by = first_given(*group);
      for (const char* option : {"--draw", "--rows", "--details", "--by", "--deploy"}) {
        if (verb.count(option) > 0) chosen_by = option;
      }
      if (!chosen_by.empty()) throw only_of_a_catalogue(call->path, chosen_by);
      write_report_of_pattern(*call);
      return 0;
    }
    if (call->choice.where.empty()) check_by(call->choice);
    write_report(*call);
    return 0;
  };
}

}  // namespace misalign::search
