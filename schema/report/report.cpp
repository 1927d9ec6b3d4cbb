#include "schema/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/named_queries.hpp"
#include "schema/catalogue/result_table.hpp"
#include "schema/catalogue/study_table.hpp"
#include "schema/exchange/deploy_json.hpp"
#include "schema/files/base64.hpp"
#include "schema/files/carried_files.hpp"
#include "schema/files/features.hpp"
#include "schema/files/json_values.hpp"
#include "schema/pattern/fill_words.hpp"
#include "schema/pattern/pattern_json.hpp"
#include "schema/records/fault_sample.hpp"
#include "solver/pattern/outline.hpp"

namespace misalign::schema {
namespace {

using Eigen::Index;

constexpr const char* kPage = "report_page.html";
constexpr std::string_view kPlaceOfWords = "@REPORT_WORDS@", kPlaceOfData = "@REPORT_DATA@",
                           kPlaceOfServer = "@REPORT_SERVER@";
constexpr std::string_view kBeforePolicy = R"(http-equiv="Content-Security-Policy" content=")";

std::string floats(const std::vector<double>& numbers) {
  return base64(std::vector<float>(numbers.begin(), numbers.end()));
}

std::vector<double> lengths_row_by_row(const solver::FoldingHistory& history) {
  std::vector<double> lengths_mm = history.flat_mm;
  const auto rows = history.length_mm.reshaped<Eigen::RowMajor>();
  lengths_mm.insert(lengths_mm.end(), rows.begin(), rows.end());
  return lengths_mm;
}

Json shapes_json(const solver::Sheet& sheet) {
  const Eigen::Matrix2Xd& flat_mm = sheet.vertices_mm();
  constexpr double kLeastUnit_mm = 0.01, kMostUnits = 32000;
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  centre_mm.head<2>() = (flat_mm.rowwise().minCoeff() + flat_mm.rowwise().maxCoeff()) / 2;
  double farthest_mm = (flat_mm.colwise() - centre_mm.head<2>()).cwiseAbs().maxCoeff();
  for (const auto& shape_mm : sheet.shapes_mm()) {
    farthest_mm = std::max(farthest_mm, (shape_mm.colwise() - centre_mm).cwiseAbs().maxCoeff());
  }
  const double unit_mm = std::max(kLeastUnit_mm, farthest_mm / kMostUnits);
  std::vector<std::int16_t> units;
  const auto append = [&](double x, double y, double z) {
    for (const double mm : {x - centre_mm.x(), y - centre_mm.y(), z}) {
      units.push_back(static_cast<std::int16_t>(std::lround(mm / unit_mm)));
    }
  };
  for (Index v = 0; v < flat_mm.cols(); ++v) append(flat_mm(0, v), flat_mm(1, v), 0);
  for (const auto& shape_mm : sheet.shapes_mm()) {
    for (Index v = 0; v < shape_mm.cols(); ++v) {
      append(shape_mm(0, v), shape_mm(1, v), shape_mm(2, v));
    }
  }
  return {{"unit_mm", unit_mm}, {"data", base64(units)}};
}

// Escapes <: "</script>" in a text would end the data.
std::string embedded(const Json& data) {
  std::string json;
  for (const char c : data.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    c == '<' ? json += "\\u003c" : json += c;
  }
  return json;
}

// Rows of a table for the candidates in the page's table, and for `draws`.
Json rows_of(SQLite::Database& database, const std::string& columns_from_table, std::uint64_t most,
             const std::vector<std::uint64_t>& draws, const std::string& order) {
  std::string these;
  for (const std::uint64_t draw : draws)
    these += (these.empty() ? "" : ", ") + std::to_string(draw);
  Json rows = query_rows(database, "SELECT " + columns_from_table +
                                       " WHERE draw IN (SELECT draw FROM candidates " +
                                       best_order() + " LIMIT " + std::to_string(most) +
                                       ") OR draw IN (" + these + ") ORDER BY " + order);
  for (Json& row : rows) row["draw"] = row["draw"].dump();
  return rows;
}

// `server`: the connect-src of the page's Content-Security-Policy.
std::string page_with(const Json& data, std::string_view server) {
  need("Node.js");
  std::string text = carried_text(kPage);
  const auto put = [&](std::string_view place, std::string_view there) {
    text.replace(text.find(place), place.size(), there);
  };
  put(kPlaceOfServer, server);
  put(kPlaceOfWords, embedded(words_json()));
  put(kPlaceOfData, embedded(data));  // last: no other place is found in the data
  return text;
}

}  // namespace

Json words_json() {
  const Json faults = json_list(solver::fault_table(), [](const solver::FaultEntry& fault) {
    return Json{{"name", fault.name}, {"label", fault.label}, {"meaning", fault.meaning}};
  });
  Json metrics = Json::array();
  for (const MetricEntry& metric : metric_table()) {
    if (!metric.label) continue;
    const std::string unit = metric.unit;
    Json& json = metrics.emplace_back();
    json = {{"name", metric.name},
            {"label", metric.label},
            {"unit", unit == "count" ? "" : unit},
            {"meaning", metric.meaning},
            {"written", unit == "share" || unit == "count" ? unit : metric.written},
            {"better", metric.less_is_better ? "less" : "more"}};
    if (metric.none_is_best) json["none_is_best"] = true;
    if (metric.negative_is_bad) json["negative_is_bad"] = true;
    if (metric.needs_a_campaign) json["needs_a_campaign"] = true;
    if (metric.usual) json["usual"] = true;
    if (metric.schema_since > 1 && !metric.none_is_best) json["may_be_unknown"] = true;
  }
  Json columns = Json::array();
  for (const StudyEntry& study : study_table()) {
    for (const StudyColumn& column : study.columns) {
      columns.push_back({{"name", column.name},
                         {"label", column.label},
                         {"unit", column.unit},
                         {"meaning", column.meaning},
                         {"better", column.less_is_better ? "less" : "more"}});
      if (column.usual) columns.back()["usual"] = true;
    }
  }
  return {{"faults", faults}, {"metrics", metrics}, {"columns_of_studies", columns}};
}

std::string candidates_sql(std::uint64_t most, const std::vector<std::string_view>& functions) {
  std::string sql = "SELECT * FROM candidates " + best_order() + " LIMIT " + std::to_string(most);
  if (!functions.empty()) {  // evaluated for the shown rows alone
    std::string found;
    for (const std::string_view name : functions) found += fmt::format(", {0}(draw) AS {0}", name);
    sql = "SELECT *" + found + " FROM (" + sql + ")";
  }
  return sql;
}

Json candidates_json(SQLite::Database& database, std::uint64_t most,
                     const std::vector<std::string_view>& functions) {
  const Json rows = query_rows(database, candidates_sql(most, functions));
  const Json total = query_rows(database, "SELECT count(*) AS total FROM candidate");
  Json columns = Json::object();
  for (const Json& row : rows) {
    if (const Json draw = row.value("draw", Json()); !draw.is_number_integer() || draw < 0) {
      throw damaged(database, "a candidate's draw is " + draw.dump());
    }
    for (const auto& [column, value] : row.items()) {
      columns[column].push_back(column == "draw" ? Json(value.dump()) : value);
    }
  }
  return {{"total", total[0]["total"]}, {"shown", rows.size()}, {"columns", columns}};
}

Json report_yields_json(SQLite::Database& database, std::uint64_t most,
                        const std::vector<std::uint64_t>& draws) {
  return rows_of(
      database,
      "draw, amplitude_mm, from_deg, trials, survivors, undecided, share, share_low, share_high "
      "FROM yields",
      most, draws, "draw, amplitude_mm, from_deg");
}

Json report_certificates_json(SQLite::Database& database, std::uint64_t most,
                              const std::vector<std::uint64_t>& draws) {
  Json rows = rows_of(database,
                      "draw, certified_deg, ended AS \"end\", nullif(place, '') AS \"where\", "
                      "contact, intervals FROM certificate",
                      most, draws, "draw");
  for (Json& row : rows) row["contact"] = row["contact"] != 0;
  return rows;
}

Json faults_json(SQLite::Database& database, const Campaign& campaign) {
  Json rows = query_rows(database,
                         "SELECT first_fault, fault_deg, \"where\", deploys_from_sample >= " +
                             std::to_string(campaign.threshold_sample()) +
                             " AND first_fault != 'undecided' AS accepted, count(*) AS sampled, "
                             "total(stands_for) AS weight, total(1.0 * stands_for * stands_for) AS "
                             "weight_sq FROM fault_sample GROUP BY 1, 2, 3, 4 ORDER BY 1, 2, 3, 4");
  for (Json& row : rows) row["accepted"] = row["accepted"] != 0;
  const Json most = query_rows(database, "SELECT max(stands_for) AS weight FROM fault_sample");
  return {{"every", kFaultSampleEvery},
          {"every_at_most", rows.empty() ? Json(kFaultSampleEvery) : most[0]["weight"]},
          {"rows", rows}};
}

Json sheet_json(const Pattern& base, const solver::Mechanism& mechanism) {
  const solver::CreasePattern& sheet = base.base.sheet;
  Json vertices = Json::array(), panels = Json::array(), places = Json::array(),
       holes = Json::array(), creases = Json::array(), cuts = Json::array(), balls = Json::array();
  for (const auto& place : sheet.vertices_mm.colwise()) vertices.push_back({place.x(), place.y()});
  for (const int f : solver::kept_facets(sheet, base.base.holes)) {
    panels.push_back(sheet.facets[f]);
    places.push_back(sheet.places[f]);
  }
  for (const int f : base.base.holes) {
    holes.push_back({{"place", sheet.places[f]}, {"corners", sheet.facets[f]}});
  }
  for (const solver::Crease& crease : mechanism.creases) {
    creases.push_back({{"a", crease.a},
                       {"b", crease.b},
                       {"assignment", mechanism.is_valley(crease) ? "valley" : "mountain"}});
  }
  for (const auto& outline : solver::outlines(sheet, base.base.holes)) {
    for (std::size_t k = 0; k < outline.size(); ++k) {
      cuts.push_back({outline[k], outline[(k + 1) % outline.size()]});
    }
  }
  for (const solver::BallJoint& ball : mechanism.balls) balls.push_back(ball.vertex);
  const solver::Crease& pilot = mechanism.creases[mechanism.pilot];
  return {{"vertices_mm", vertices}, {"panels", panels},           {"panel_places", places},
          {"holes", holes},          {"creases", creases},         {"cuts", cuts},
          {"ball_joints", balls},    {"pilot", {pilot.a, pilot.b}}};
}

Json path_json(const FoldingView& view) {
  const solver::Metrics* const metrics = view.sheet.metrics();
  std::vector<double> pilot_deg = {0};
  for (const solver::Station& station : view.history.stations) {
    pilot_deg.push_back(station.pilot_deg);
  }
  return {{"verdict", verdict_json(view)},
          {"fold_limit_deg", view.history.path.fold_limit_deg},
          {"metrics", metrics ? metrics_json(*metrics) : Json()},
          {"displacements_mm", displacements_json(view.shifts_mm)},
          {"pilot_deg", pilot_deg},
          {"length_mm", floats(lengths_row_by_row(view.history))}};
}

Json detail_json(const FoldingView& view, std::uint64_t draw, bool accepted,
                 const solver::Actuation& actuation) {
  Json json = path_json(view);
  json.update({{"draw", std::to_string(draw)},
               {"accepted", accepted},
               {"vertices_mm", shapes_json(view.sheet)},
               {"energy_n_mm", floats(actuation.energy_n_mm)},
               {"moment_n_mm", floats(actuation.moment_n_mm)},
               {"mechanical_advantage", floats(actuation.mechanical_advantage)}});
  if (!are_equal_springs(actuation.actuators.fill)) {
    const Eigen::Matrix<double, -1, -1, Eigen::RowMajor> force_n = actuation.force_n;
    json["force_n"] = floats(std::vector<double>(force_n.data(), force_n.data() + force_n.size()));
  }
  json.update(limits_json(actuation));
  return json;
}

Json page_deployment_json(const solver::DeploymentStudy& study) {
  std::vector<double> time_s, pilot_deg;
  for (const solver::Deployment::Row& row : study.run.rows) {
    time_s.push_back(row.time_s);
    pilot_deg.push_back(row.pilot_deg);
  }
  const solver::Deployment::Row& last = study.run.last();
  Json json = deployment_metrics_json(study);
  json.update({{"from_deg", study.options.from_deg},
               {"outcome", solver::name_of(study.run.outcome)},
               {"thickness_mm", study.sheet.plates.thickness_mm},
               {"mass_g", study.mass_t * 1e6},
               {"end_deg_per_s", last.rate_deg_per_s},
               {"time_s", floats(time_s)},
               {"pilot_deg", floats(pilot_deg)}});
  return json;
}

std::string report_page(const Json& data) { return page_with(data, "'none'"); }

ServedPage served_page(const Json& data) {
  ServedPage page{page_with(data, "'self'"), ""};
  const std::size_t begin = page.text.find(kBeforePolicy) + kBeforePolicy.size();
  page.policy = page.text.substr(begin, page.text.find('"', begin) - begin);
  page.policy += "; frame-ancestors 'none'";
  return page;
}

}  // namespace misalign::schema
