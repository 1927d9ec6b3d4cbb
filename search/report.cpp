#include "search/report.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>

#include "schema/catalogue_state.hpp"
#include "schema/report.hpp"
#include "schema/result_table.hpp"
#include "search/build_info.hpp"
#include "search/folded_draw.hpp"
#include "search/status.hpp"

namespace misalign::search {
namespace {

using schema::Json;

// Details may take about so much of the page; large sheets get fewer of them.
constexpr std::size_t kMostDetailBytes = 24 << 20;

// A word for a shell.
std::string quoted(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) ||
           std::string("_-./=:,+@%").find(static_cast<char>(c)) != std::string::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

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

}  // namespace

void write_report(const ReportOptions& options) {
  const auto database = schema::open_for_reading(options.catalogue_path);
  schema::Campaign campaign = schema::read_campaign_of(*database, options.catalogue_path);
  campaign.actuators = options.actuators.instead_of(campaign.actuators);
  const DrawFolder folder(campaign);
  const solver::Mechanism& mechanism = folder.mechanism();
  Json diagonals = Json::array();
  for (const solver::Diagonal& diagonal : mechanism.diagonals) {
    diagonals.push_back(
        {{"hole", schema::facet_json(campaign.pattern, mechanism.loops[diagonal.loop].hole)},
         {"from", solver::vertex_label(diagonal.from)},
         {"to", solver::vertex_label(diagonal.to)},
         {"from_vertex", diagonal.from},
         {"to_vertex", diagonal.to}});
  }
  const Json candidates = schema::candidates_json(*database, options.rows);
  const auto& limit = campaign.actuators.stroke_limit;
  const Json data = {
      {"format", 1},
      {"program", {{"version", build_info().version}, {"commit", build_info().commit}}},
      {"written_at", now()},
      {"catalogue", options.catalogue_path},
      {"commands",
       {{"misalign", "misalign"},
        {"catalogue", quoted(options.catalogue_path)},
        {"output", quoted(options.output)}}},
      {"campaign",
       {{"name", campaign.name},
        {"identity", schema::identity(campaign)},
        {"configuration", schema::campaign_json(campaign)}}},
      {"state", status_json(schema::read_state(*database))},
      {"faults", schema::faults_json(*database, campaign)},
      {"sheet", schema::sheet_json(campaign.pattern, mechanism)},
      {"diagonals", diagonals},
      {"candidates", candidates},
      {"actuators",
       {{"stiffness_n_per_mm", campaign.actuators.stiffness_n_per_mm},
        {"stroke_limit", limit ? Json(*limit) : Json()}}},
      {"details",
       details_json(folder, draws_to_look_at(candidates, options), options.draws.size())}};
  write_file(options.output, schema::report_page(data));
  std::puts(options.output.c_str());
}

}  // namespace misalign::search
