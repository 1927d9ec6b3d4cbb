#include "search/report.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "schema/catalogue_state.hpp"
#include "schema/report.hpp"
#include "schema/text_file.hpp"
#include "search/build_info.hpp"
#include "search/shell_word.hpp"
#include "search/status.hpp"

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

// Those asked for, then the best ones, none twice.
std::vector<std::uint64_t> draws_to_look_at(const Json& candidates, const ReportOptions& options) {
  std::vector<std::uint64_t> draws = options.draws;
  const Json best = candidates["columns"].value("draw", Json::array());
  for (std::size_t k = 0; k < std::min<std::size_t>(best.size(), options.details); ++k) {
    draws.push_back(std::stoull(best[k].get<std::string>()));
  }
  std::vector<std::uint64_t> once;
  for (const std::uint64_t draw : draws) {
    if (std::find(once.begin(), once.end(), draw) == once.end()) once.push_back(draw);
  }
  return once;
}

Json details_json(const DrawFolder& folder, const std::vector<std::uint64_t>& draws,
                  std::size_t asked_for) {
  Json details = Json::array();
  std::size_t bytes = 0;
  for (std::size_t k = 0; k < draws.size() && (k < asked_for || bytes < kMostDetailBytes); ++k) {
    const FoldedDraw folded = folder.fold(draws[k]);
    details.push_back(schema::detail_json(folder.view(folded), folded.draw, folded.accepted,
                                          folded.path, folded.actuation, folded.metrics));
    bytes += details.back().dump().size();
  }
  return details;
}

Json diagonals_json(const schema::Pattern& pattern, const solver::Mechanism& mechanism) {
  Json diagonals = Json::array();
  for (const solver::Diagonal& diagonal : mechanism.diagonals) {
    diagonals.push_back({{"hole", schema::facet_json(pattern, mechanism.loops[diagonal.loop].hole)},
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

// What the catalogue says, all of it of one moment: a search may be writing.
Json catalogue_json(SQLite::Database& database, const schema::Campaign& campaign,
                    std::uint64_t rows) {
  return schema::reading(database, [&] {
    const SQLite::Transaction moment(database);
    return Json{{"state", status_json(schema::read_state(database))},
                {"faults", schema::faults_json(database, campaign)},
                {"candidates", schema::candidates_json(database, rows)}};
  });
}

}  // namespace

void write_report(const ReportOptions& options) {
  std::error_code error;
  if (std::filesystem::equivalent(options.output, options.catalogue_path, error)) {
    throw schema::UserError(schema::kExitUsage, "--output " + options.output +
                                                    ": is the catalogue itself; name another file");
  }
  const auto database = schema::open_for_reading(options.catalogue_path);
  schema::Campaign campaign = schema::read_campaign_of(*database, options.catalogue_path);
  campaign.actuators = options.actuators.instead_of(campaign.actuators);
  const Json catalogue = catalogue_json(*database, campaign, options.rows);
  const DrawFolder folder(campaign);
  const auto& limit = campaign.actuators.stroke_limit;
  Json data = {{"format", 1},
               {"program", {{"version", build_info().version}, {"commit", build_info().commit}}},
               {"written_at", now()},
               {"catalogue", options.catalogue_path},
               {"commands",
                {{"misalign", "misalign"},
                 {"catalogue", shell_word(options.catalogue_path)},
                 {"springs", options_of(options.actuators)},
                 {"output", shell_word(options.output)}}},
               {"campaign",
                {{"name", campaign.name},
                 {"identity", schema::identity(campaign)},
                 {"configuration", schema::campaign_json(campaign)}}},
               {"sheet", schema::sheet_json(campaign.pattern, folder.mechanism())},
               {"diagonals", diagonals_json(campaign.pattern, folder.mechanism())},
               {"actuators",
                {{"stiffness_n_per_mm", campaign.actuators.stiffness_n_per_mm},
                 {"stroke_limit", limit ? Json(*limit) : Json()}}},
               {"details", details_json(folder, draws_to_look_at(catalogue["candidates"], options),
                                        options.draws.size())}};
  data.update(catalogue);
  schema::write_text_file(options.output, schema::report_page(data));
  std::puts(options.output.c_str());
}

}  // namespace misalign::search
