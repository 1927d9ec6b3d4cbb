#include "search/report/report_data.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/status_json.hpp"
#include "schema/catalogue/study_table.hpp"
#include "schema/exchange/actuators_json.hpp"
#include "schema/files/json_values.hpp"
#include "schema/files/suggestion.hpp"
#include "schema/memory/study_memory.hpp"
#include "schema/pattern/fill_json.hpp"
#include "schema/pattern/fill_words.hpp"
#include "schema/report/report.hpp"
#include "search/draws/draw.hpp"
#include "search/report/live_state.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/sheets/study_functions.hpp"
#include "search/terminal/build_info.hpp"
#include "search/terminal/long_work.hpp"
#include "search/terminal/shell_word.hpp"
#include "search/terminal/site.hpp"

namespace misalign::search {
namespace {

using schema::Json;

// Approximate largest size of all details on the page; it holds fewer large sheets.
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

// Different draws with details; the first `requested` have them whatever their size.
struct DetailedDraws {
  std::vector<std::uint64_t> draws;
  std::size_t requested = 0;

  void add(const std::vector<std::uint64_t>& more) {
    for (const std::uint64_t draw : more) {
      if (std::find(draws.begin(), draws.end(), draw) == draws.end()) draws.push_back(draw);
    }
  }
};

DetailedDraws detailed_draws(SQLite::Database& database, const Json& candidates,
                             const ReportCall& call) {
  DetailedDraws detailed;
  detailed.add(call.draws);
  detailed.requested = detailed.draws.size();
  Choice choice = call.choice;
  const bool counted = choice.best || choice.diverse;
  if (!choice.chooses()) {
    detailed.add(first_in_table(candidates, call.details));
  } else if (call.details > 0 && (candidates["total"] > 0 || !choice.where.empty())) {
    if (!counted) choice.best = call.details;
    detailed.add(chosen_draws(database, choice));
  }
  if (counted) detailed.requested = detailed.draws.size();
  return detailed;
}

Json detail_json(SQLite::Database& database, const schema::Campaign& campaign, FoldingModel& model,
                 std::uint64_t draw, const ReportDetails& details) {
  const solver::Sheet sheet = model.sheet(shifts_of_number(database, campaign, draw));
  Json json = details.of_draw(sheet, draw, campaign.accepts(sheet.history().verdict));
  if (!campaign.search.has_ends()) return json;
  Json ascent = schema::read_ascent(database, draw);
  if (!ascent.is_object()) return json;
  ascent["limited_by"] = schema::json_of(ascent["limited_by"]);
  if (!campaign.search.splitting) {  // its starts are not stored
    const solver::Sheet start = model.sheet(shifts_of_draw(campaign, draw));
    ascent["start"] = schema::path_json({campaign.pattern, start});
  }
  json["ascent"] = std::move(ascent);
  return json;
}

Json details_json(SQLite::Database& database, const schema::Campaign& campaign, FoldingModel& model,
                  const DetailedDraws& detailed, const ReportDetails& details,
                  const ReportCall& call) {
  Json json = Json::array();
  const bool is_large = campaign.pattern.base.sheet.vertex_count() > call.largest_detailed;
  std::size_t bytes = 0;
  for (std::size_t k = 0; k < detailed.draws.size(); ++k) {
    if (k >= detailed.requested && (is_large || bytes >= kMostDetailBytes)) break;
    if (call.is_stopped && call.is_stopped()) {
      throw schema::UserError(schema::Cause::failure,
                              "stopped before the details of all sheets were computed");
    }
    show_work("details computed", k, detailed.draws.size());
    json.push_back(detail_json(database, campaign, model, detailed.draws[k], details));
    bytes += json.back().dump().size();
  }
  return json;
}

Json diagonals_json(const schema::Pattern& pattern, const solver::Mechanism& mechanism,
                    const solver::Fill& fill) {
  const auto* const springs = std::get_if<solver::Springs>(&fill);
  const Eigen::VectorXd preload_n =
      (springs ? springs->preload : solver::Preload{}).forces_n(mechanism.diagonals);
  Json diagonals = Json::array();
  for (const solver::Diagonal& diagonal : mechanism.diagonals) {
    diagonals.push_back({{"diagonal", diagonals.size()},
                         {"hole", schema::facet_json(pattern, mechanism.loops[diagonal.loop].hole)},
                         {"from", solver::vertex_label(diagonal.from)},
                         {"to", solver::vertex_label(diagonal.to)},
                         {"from_vertex", diagonal.from},
                         {"to_vertex", diagonal.to},
                         {"preload_n", preload_n(static_cast<Eigen::Index>(diagonals.size()))}});
  }
  return diagonals;
}

// Returns the given options of a design, for the page's commands.
std::string options_of(const schema::Design& design) {
  std::string text;
  if (design.from_deg) text += " --from " + schema::shown_number(*design.from_deg);
  const bool is_plain = design.is_springs() && design.other_preloads.empty() &&
                        schema::are_equal_springs(design.springs());
  if (!is_plain) return text + " --fill " + shell_word(schema::fill_json(design).dump());
  if (const auto& k = design.stiffness_n_per_mm) text += " --stiffness " + schema::shown_number(*k);
  if (const auto& preload = design.preload_n) {
    text += " --preload " + schema::shown_number(*preload);
  }
  if (const auto& limit = design.stroke_limit) {
    text += " --stroke-limit " + schema::shown_number(*limit);
  }
  return text;
}

// Describes the choice of draws with details.
Json chosen_json(const ReportCall& call) {
  const Choice& choice = call.choice;
  return {{"draws", call.draws.size()},
          {"best", schema::or_null(choice.best)},
          {"diverse", schema::or_null(choice.diverse)},
          {"where", choice.where.empty() ? Json() : Json(choice.where)},
          {"by", schema::or_null(choice.by)}};
}

// Returns the SQL functions of the requested studies and columns.
std::vector<std::string_view> columns_of(const schema::Campaign& campaign, const ReportCall& call) {
  std::vector<std::string_view> functions;
  for (const auto& [name, is_asked] : call.studies) {
    if (!is_asked) continue;
    for (const schema::StudyColumn& column : schema::study_named(name).columns) {
      if (column.in_report) functions.push_back(column.name);
    }
  }
  for (const std::string& name :
       call.only_remembered ? schema::StudyMemory(call.path, campaign).functions() : call.columns) {
    const schema::StudyColumn* const column = schema::study_column(name);
    if (!column) {
      throw schema::UserError(
          schema::Cause::bad_request,
          fmt::format("{}: {}; choose one of {}", schema::parameter("column"),
                      schema::unknown_word(schema::printable(name), "function of a sheet",
                                           schema::study_functions()),
                      fmt::join(schema::study_functions(), ", ")));
    }
    if (std::ranges::find(functions, column->name) == functions.end()) {
      functions.push_back(column->name);
    }
  }
  return functions;
}

// Returns the parts of the commands that the page suggests.
Json commands_json(const ReportCall& call) {
  std::string choice = text_of(call.choice);
  if (call.details != ReportCall().details) {
    choice += " --details " + std::to_string(call.details);
  }
  if (call.rows != ReportCall().rows) choice += " --rows " + std::to_string(call.rows);
  if (!call.beside.empty()) choice += " --beside " + shell_path(call.beside);
  for (const auto& [name, is_asked] : call.studies) {
    if (is_asked) choice += fmt::format(" --{}", name);
  }
  for (const std::string& name : call.columns) choice += " --column " + name;
  return {{"misalign", "misalign"},
          {"catalogue", shell_path(call.path)},
          {"choice", choice},
          {"springs", options_of(call.design)},
          {"output", shell_path(call.output)}};
}

// Reads the catalogue at one moment, since a search may be writing.
Json catalogue_json(SQLite::Database& database, const schema::Campaign& campaign,
                    const ReportCall& call, DetailedDraws& detailed) {
  const std::vector<std::string_view> functions = columns_of(campaign, call);
  return schema::reading(database, [&] {
    const SQLite::Transaction moment(database);
    look_ahead(database, schema::candidates_sql(call.rows, functions));
    Json json = {{"state", schema::page_state_json(schema::read_state(database))},
                 {"faults", schema::faults_json(database, campaign)},
                 {"candidates", schema::candidates_json(database, call.rows, functions)}};
    if (!call.beside.empty()) json["angles"] = angles_json(database, campaign.sample_deg);
    detailed = detailed_draws(database, json["candidates"], call);
    json["yields"] = schema::report_yields_json(database, call.rows, detailed.draws);
    json["certificates"] = schema::report_certificates_json(database, call.rows, detailed.draws);
    return json;
  });
}

Json whose_json(const schema::Campaign& campaign) {
  return {{"name", campaign.name},
          {"identity", schema::identity(campaign)},
          {"configuration", schema::campaign_json(campaign)}};
}

void refuse_splitting(const schema::Campaign& campaign, const std::string& path) {
  if (!campaign.search.splitting) return;
  throw schema::UserError(schema::Cause::bad_request,
                          path + ": a splitting search has no fault sample to compare; leave out " +
                              schema::parameter("beside"));
}

// Reads what the page compares of another catalogue.
Json beside_json(const std::string& path) {
  const auto database = schema::open_for_reading(path);
  const schema::Campaign campaign = schema::read_campaign_of(*database, path);
  refuse_splitting(campaign, path);
  Json json = live_state_json(*database, campaign);
  json["catalogue"] = path;
  json["campaign"] = whose_json(campaign);
  return json;
}

// Describes the sheet, its diagonals and springs.
Json folding_json(const FoldingModel& model) {
  const solver::Actuators actuators = model.actuators();
  Json filling = {
      {"stroke_limit", schema::or_null(actuators.stroke_limit)},
      {"words", schema::filling_words(actuators.fill, model.mechanism().diagonal_count(),
                                      schema::kDegreeSign)},
      {"parts", schema::fill_nouns(actuators.fill).parts},
      {"equal_springs", schema::are_equal_springs(actuators.fill)}};
  schema::add_filling(actuators.fill, model.base().base, filling);
  return {{"sheet", schema::sheet_json(model.base(), model.mechanism())},
          {"diagonals", diagonals_json(model.base(), model.mechanism(), actuators.fill)},
          {"actuators", filling}};
}

// Returns the relative path from the page to the manual's site, which reveals no more of this
// machine's folders.
Json manual_json(const ReportCall& call) {
  const auto site = place_of_site();
  if (!site || call.output.empty()) return nullptr;
  const auto folder = std::filesystem::absolute(call.output).parent_path();
  return std::filesystem::proximate(*site, folder).generic_string();
}

// Describes the page's program, its source, and the commands that write it again.
Json origin_json(const ReportCall& call) {
  return {{"format", 1},
          {"program", {{"version", build_info().version}, {"commit", build_info().commit}}},
          {"written_at", now()},
          {"catalogue", call.path},
          {"manual", manual_json(call)},
          {"chosen", chosen_json(call)},
          {"commands", commands_json(call)}};
}

// Gives draws with a result of `misalign stress` details of any size. UserError (bad_input) if one
// is not among those shown.
void require_stressed_draws(const ReportCall& call, const std::vector<std::uint64_t>& stressed,
                            DetailedDraws& detailed) {
  for (std::size_t k = 0; k < stressed.size(); ++k) {
    const auto at = std::find(detailed.draws.begin(), detailed.draws.end(), stressed[k]);
    if (at == detailed.draws.end()) {
      throw schema::UserError(
          schema::Cause::bad_input,
          fmt::format("{}: is a result for draw {}, which has no details on this page; add {}",
                      call.detail.stress_files[k], stressed[k],
                      schema::parameter("draw", std::to_string(stressed[k]))));
    }
    detailed.requested =
        std::max(detailed.requested, static_cast<std::size_t>(at - detailed.draws.begin()) + 1);
  }
}

}  // namespace

Json report_of_catalogue(const ReportCall& call) {
  const auto database = schema::open_for_reading(call.path);
  schema::Campaign campaign = schema::read_campaign_of(*database, call.path);
  Json beside;
  if (!call.beside.empty()) {
    refuse_splitting(campaign, call.path);
    beside = beside_json(call.beside);
  }
  campaign.design = call.design.merged_over(campaign.design);
  FoldingModel model(campaign);
  add_study_functions(*database, campaign, call.path,
                      call.only_remembered ? Unknown::is_null : Unknown::is_computed);
  const ReportDetails details(model, call.detail, campaign.target.get());
  const std::vector<std::uint64_t> stressed = details.draws_with_stress(campaign);
  DetailedDraws detailed;
  const Json catalogue = catalogue_json(*database, campaign, call, detailed);
  require_stressed_draws(call, stressed, detailed);
  Json data = origin_json(call);
  data["campaign"] = whose_json(campaign);
  if (campaign.energy) {
    data["campaign"]["judged_filling"] = schema::filling_words(
        campaign.energy->fill, model.mechanism().diagonal_count(), schema::kDegreeSign);
  }
  data.update(catalogue);
  if (!beside.is_null()) data["beside"] = std::move(beside);
  data.update(folding_json(model));
  data["details"] = details_json(*database, campaign, model, detailed, details, call);
  return data;
}

Json report_of_pattern(const ReportCall& call) {
  const ChosenSheet chosen = sheet_of_pattern_file(call.path);
  FoldingModel model(chosen.base, chosen.sampling, call.design.merged_over(chosen.design));
  const ReportDetails details(model, call.detail, chosen.target ? &*chosen.target : nullptr);
  details.check_stress(call.path, chosen.whose()["sheet"]);
  Json data = origin_json(call);
  data["pattern"] = {{"name", chosen.pattern},
                     {"sampling", schema::sampling_json(chosen.sampling)}};
  data["candidates"] = {{"total", 0}, {"shown", 0}, {"columns", Json::object()}};
  data.update(folding_json(model));
  const solver::Sheet sheet = model.sheet(chosen.shifts_mm);
  data["details"] = Json::array({details.of_pattern(sheet, chosen.pattern)});
  return data;
}

}  // namespace misalign::search
