#include "search/verbs/report.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/files/text_file.hpp"
#include "schema/report/report.hpp"
#include "search/checks/chosen_sheet.hpp"
#include "search/draws/draw.hpp"
#include "search/ranks/build_info.hpp"
#include "search/terminal/shell_word.hpp"
#include "search/terminal/status_text.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/choice_options.hpp"

namespace misalign::search {
namespace {

using schema::Json;

// Details may take about so much of the page; large sheets get fewer of them.
constexpr std::size_t kMostDetailBytes = 24 << 20;

std::string now() {
  const std::time_t time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char text[40];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&time));
  return text;
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
                               const ReportOptions& options) {
  DrawsToLookAt look;
  look.add(options.draws);
  look.asked_for = look.draws.size();
  Choice choice = options.choice;
  const bool counted = choice.best || choice.diverse;
  if (!choice.chooses()) {
    look.add(first_in_table(candidates, options.details));
  } else if (options.details > 0 && (candidates["total"] > 0 || !choice.where.empty())) {
    if (!counted) choice.best = options.details;
    look.add(chosen_draws(database, choice));
  }
  if (counted) look.asked_for = look.draws.size();
  return look;
}

Json details_json(const schema::Campaign& campaign, const SheetFolder& folder,
                  const DrawsToLookAt& look) {
  Json details = Json::array();
  std::size_t bytes = 0;
  for (std::size_t k = 0; k < look.draws.size(); ++k) {
    if (k >= look.asked_for && bytes >= kMostDetailBytes) break;
    const std::uint64_t draw = look.draws[k];
    const FoldedSheet folded = folder.fold(shifts_of_draw(campaign, draw));
    const bool accepted = campaign.accepts(folded.path.history.verdict);
    details.push_back(schema::detail_json(folder.view(folded), draw, accepted, folded.path,
                                          folded.actuation, folded.metrics));
    bytes += details.back().dump().size();
  }
  return details;
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
Json chosen_json(const ReportOptions& options) {
  const Choice& choice = options.choice;
  return {{"draws", options.draws.size()},
          {"best", choice.best ? Json(*choice.best) : Json()},
          {"diverse", choice.diverse ? Json(*choice.diverse) : Json()},
          {"where", choice.where.empty() ? Json() : Json(choice.where)},
          {"by", choice.by ? Json(*choice.by) : Json()}};
}

// What the page's commands are made of: it shows how to go on from what it shows.
Json commands_json(const ReportOptions& options) {
  std::string choice = text_of(options.choice);
  if (options.details != ReportOptions().details) {
    choice += " --details " + std::to_string(options.details);
  }
  if (options.rows != ReportOptions().rows) choice += " --rows " + std::to_string(options.rows);
  return {{"misalign", "misalign"},
          {"catalogue", shell_word(options.path)},
          {"choice", choice},
          {"springs", options_of(options.actuators)},
          {"output", shell_word(options.output)}};
}

// What the catalogue says, all of it of one moment: a search may be writing.
Json catalogue_json(SQLite::Database& database, const schema::Campaign& campaign,
                    const ReportOptions& options, DrawsToLookAt& look) {
  return schema::reading(database, [&] {
    const SQLite::Transaction moment(database);
    Json json = {{"state", status_json(schema::read_state(database))},
                 {"faults", schema::faults_json(database, campaign)},
                 {"candidates", schema::candidates_json(database, options.rows)}};
    look = draws_to_look_at(database, json["candidates"], options);
    json["yields"] = schema::report_yields_json(database, options.rows, look.draws);
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
Json origin_json(const ReportOptions& options) {
  return {{"format", 1},
          {"program", {{"version", build_info().version}, {"commit", build_info().commit}}},
          {"written_at", now()},
          {"catalogue", options.path},
          {"chosen", chosen_json(options)},
          {"commands", commands_json(options)}};
}

void refuse_own_input(const ReportOptions& options) {
  std::error_code error;
  if (!std::filesystem::equivalent(options.output, options.path, error)) return;
  throw schema::UserError(
      schema::kExitUsage,
      "--output " + options.output + ": is the file itself that is shown; name another file");
}

void write_page(const ReportOptions& options, const Json& data) {
  schema::write_text_file(options.output, schema::report_page(data));
  put(schema::printable(options.output) + "\n");
}

}  // namespace

void write_report(const ReportOptions& options) {
  refuse_own_input(options);
  const auto database = schema::open_for_reading(options.path);
  schema::Campaign campaign = schema::read_campaign_of(*database, options.path);
  campaign.actuators = options.actuators.instead_of(campaign.actuators);
  DrawsToLookAt look;
  const Json catalogue = catalogue_json(*database, campaign, options, look);
  const SheetFolder folder(campaign);
  Json data = origin_json(options);
  data["campaign"] = {{"name", campaign.name},
                      {"identity", schema::identity(campaign)},
                      {"configuration", schema::campaign_json(campaign)}};
  data.update(catalogue);
  data.update(folding_json(folder));
  data["details"] = details_json(campaign, folder, look);
  write_page(options, data);
}

void write_report_of_pattern(const ReportOptions& options) {
  refuse_own_input(options);
  const ChosenSheet sheet = sheet_of_pattern_file(options.path);
  const SheetFolder folder(sheet.base, sheet.sampling,
                           options.actuators.instead_of(sheet.actuators));
  const FoldedSheet folded = folder.fold(sheet.shifts_mm);
  Json detail = schema::detail_json(folder.view(folded), 0, false, folded.path, folded.actuation,
                                    folded.metrics);
  detail["draw"] = sheet.pattern;  // by which the page knows it
  detail["accepted"] = nullptr;    // by nobody
  Json data = origin_json(options);
  data["pattern"] = {{"name", sheet.pattern}, {"sampling", schema::sampling_json(sheet.sampling)}};
  data["candidates"] = {{"total", 0}, {"shown", 0}, {"columns", Json::object()}};
  data.update(folding_json(folder));
  data["details"] = Json::array({detail});
  write_page(options, data);
}

}  // namespace misalign::search
