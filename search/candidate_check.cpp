#include "search/candidate_check.hpp"

#include <algorithm>
#include <cmath>

#include "schema/folding_json.hpp"
#include "search/draw.hpp"
#include "solver/miscut_margin.hpp"

namespace misalign::search {
namespace {

using schema::Finding;
using schema::Json;

Finding exceeds(const std::string& where, const std::string& what, double value, double limit) {
  return {where + ": " + what + " is " + Json(value).dump() +
              " on the folded shape, must be below " + Json(limit).dump(),
          {{"where", where}, {"column", what}, {"stored", nullptr}, {"recomputed", value}}};
}

// The displacements of a row; nothing if they are no displacements of this sheet.
std::optional<Eigen::Matrix2Xd> read_shifts(const Json& text, int vertices) {
  const Json json = schema::json_of(text);
  if (!json.is_object()) return {};
  Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, vertices);
  for (const auto& [label, shift] : json.items()) {
    const int vertex = schema::vertex_of_label(label, vertices);
    if (vertex < 0 || !shift.is_array() || shift.size() != 2 || !shift[0].is_number() ||
        !shift[1].is_number()) {
      return {};
    }
    shifts_mm.col(vertex) << shift[0].get<double>(), shift[1].get<double>();
  }
  return shifts_mm;
}

solver::Mechanism mechanism_of(const solver::PerforatedSheet& base) {
  return solver::build_mechanism(base.sheet, base.holes, base.folding);
}

}  // namespace

CandidateCheck::CandidateCheck(const schema::Campaign& campaign)
    : campaign_(campaign),
      mechanism_(mechanism_of(campaign.pattern.base)),
      elimination_(solver::plan_elimination(mechanism_, campaign.pattern.base.folding,
                                            campaign.pattern.base.sheet.vertices_mm)),
      plan_(solver::plan_path(mechanism_, campaign.pattern.base.folding,
                              campaign.pattern.base.sheet.vertices_mm, campaign.path())),
      tolerances_{mechanism_.panel_width_mm, campaign.sample_deg},
      shape_(campaign.pattern.base.sheet, campaign.pattern.base.holes, mechanism_),
      panels_(solver::panels_of(campaign.pattern.base, mechanism_)) {}

Eigen::Matrix2Xd CandidateCheck::shifts_mm(std::uint64_t draw) const {
  const int vertices = campaign_.pattern.base.sheet.vertex_count();
  Eigen::Matrix2Xd drawn_mm = Eigen::Matrix2Xd::Zero(2, vertices);
  draw_shifts(campaign_.misalignment, campaign_.seed, draw, drawn_mm);
  return drawn_mm;
}

solver::Verdict CandidateCheck::verdict(std::uint64_t draw) const {
  const solver::PerforatedSheet& base = campaign_.pattern.base;
  const solver::FlatVertices vertices_mm = base.sheet.vertices_mm + shifts_mm(draw);
  return solver::record_history(base, mechanism_, elimination_, plan_, vertices_mm,
                                {campaign_.between_samples, {}})
      .verdict;
}

CandidateReport CandidateCheck::check(const Json& row, int metrics_version) const {
  CandidateReport report;
  const auto cell = [&](const char* column) {
    return row.is_object() ? row.value(column, Json()) : Json();
  };
  if (!cell("draw").is_number_integer()) {
    report.findings.push_back(
        schema::differs("a candidate", "draw", cell("draw"), "the number that it was found by"));
    return report;
  }
  const auto draw = row.at("draw").get<std::uint64_t>();
  const std::string where = "draw " + std::to_string(draw);
  const auto differs = [&](const std::string& column, const Json& stored, const Json& recomputed) {
    report.findings.push_back(schema::differs(where, column, stored, recomputed));
  };
  const solver::PerforatedSheet& base = campaign_.pattern.base;
  const Eigen::Matrix2Xd drawn_mm = shifts_mm(draw);
  const auto shifts_mm = read_shifts(cell("displacements_mm"), base.sheet.vertex_count());
  if (!shifts_mm || *shifts_mm != drawn_mm) {
    differs("displacements_mm", cell("displacements_mm"),
            schema::displacements_json(drawn_mm).dump());
  }
  if (!shifts_mm) return report;
  const solver::FlatVertices vertices_mm = base.sheet.vertices_mm + *shifts_mm;
  if (!solver::nonconvex_facets(base.sheet, vertices_mm).empty()) return report;

  std::vector<solver::FoldState<double>> states;  // of the samples in turn
  const solver::FoldingHistory history = solver::record_history(
      base, mechanism_, elimination_, plan_, vertices_mm,
      {campaign_.between_samples,
       [&](const solver::Stop& stop, const solver::FoldState<double>& state) {
         if (stop.sample == 0) return;
         states.resize(stop.sample);
         states.back() = state;
       },
       solver::margin_samples(campaign_.sample_deg, campaign_.threshold_sample())});
  if (history.verdict.deploys_from_sample == 0) {
    differs("deploys_from_sample", cell("deploys_from_sample"), 0);
    return report;
  }
  check_metrics(row, metrics_version,
                solver::measure(base, vertices_mm, history, campaign_.sample_deg), report);
  check_shapes(where, vertices_mm, history, states, report);
  return report;
}

void CandidateCheck::check_metrics(const Json& row, int metrics_version,
                                   const solver::Metrics& metrics, CandidateReport& report) const {
  const std::string where = "draw " + row.at("draw").dump();
  const auto differs = [&](const std::string& column, const Json& stored, const Json& recomputed) {
    report.findings.push_back(schema::differs(where, column, stored, recomputed));
  };
  const Json recomputed = schema::metrics_json(metrics);
  for (const auto& [column, value] : recomputed.items()) {
    const solver::MetricAge age = solver::metric_age(column);
    const bool is_younger = metrics_version < age.first;  // then null, if the column is there
    const Json stored = row.value(column, is_younger ? Json() : Json("no such column"));
    const Json expected = is_younger ? Json() : value;
    if (tolerances_.agree(column, stored, expected)) continue;
    if (!is_younger && metrics_version < age.present) {
      report.not_comparable.push_back(column);
    } else {
      differs(column, stored, expected);
    }
  }
  const std::string elongation = Json(metrics.elongation).dump();
  const Json stored_elongation = row.value("elongation", Json());
  if (!tolerances_.agree("elongation", stored_elongation, elongation)) {
    differs("elongation", stored_elongation, elongation);
  }
  for (const auto& [column, value] : row.items()) {
    static const std::vector<std::string> kOthers = {"draw", "unit", "displacements_mm",
                                                     "elongation"};
    const bool known = recomputed.contains(column) ||
                       std::find(kOthers.begin(), kOthers.end(), column) != kOthers.end();
    if (!known) differs(column, value, "a column that this program does not know");
  }
}

void CandidateCheck::check_shapes(const std::string& where, const solver::FlatVertices& vertices_mm,
                                  const solver::FoldingHistory& history,
                                  const std::vector<solver::FoldState<double>>& states,
                                  CandidateReport& report) const {
  solver::ShapeCheck shape_check(vertices_mm, panels_.corners, panels_.folds);
  ContactCheck contact_check(vertices_mm, panels_.corners);
  solver::SheetGeometry<double> geometry;
  place(mechanism_, vertices_mm, geometry);
  std::vector<double> claimed_deg(panels_.folds.size());
  for (Eigen::Index k = 0; k < history.verdict.deploys_from_sample; ++k) {
    const solver::FoldState<double>& state = states[static_cast<std::size_t>(k)];
    const Eigen::Matrix3Xd folded_mm = shape_.vertices_mm(geometry, state);
    const Eigen::Matrix3Xd corners_mm = shape_.corners_mm(geometry, state);
    for (std::size_t i = 0; i < panels_.folds.size(); ++i) {
      claimed_deg[i] = history.fold_angle_deg(k, static_cast<Eigen::Index>(i));
    }
    shape_check.see(folded_mm, corners_mm, claimed_deg);
    for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
      const solver::Diagonal& diagonal = mechanism_.diagonals[d];
      const double length_mm = (folded_mm.col(diagonal.from) - folded_mm.col(diagonal.to)).norm();
      report.diagonal_mm =
          std::max(report.diagonal_mm, std::abs(length_mm - history.length_mm(k, d)));
    }
    if (report.first_contact_deg) continue;
    if (const auto panels = contact_check.crossing(corners_mm)) {
      const auto place_of = [&](int panel) {
        return schema::facet_json(campaign_.pattern, panels_.facets[panel]).dump();
      };
      report.first_contact_deg = static_cast<double>(k + 1) * campaign_.sample_deg;
      report.contact = place_of(panels->first) + " and " + place_of(panels->second);
    }
  }
  report.shape = shape_check.worst();
  add_shape_findings(where, report);
}

void CandidateCheck::add_shape_findings(const std::string& where, CandidateReport& report) const {
  const double limit_rad = solver::shape_tolerance(panels_);
  const double limit_mm = limit_rad * mechanism_.panel_width_mm;
  const double limit_deg = limit_rad / solver::kRadPerDeg;
  const solver::ShapeErrors& shape = report.shape;
  const auto compare = [&](const char* what, double value, double limit) {
    if (!(value <= limit)) report.findings.push_back(exceeds(where, what, value, limit));
  };
  compare("length_mm", shape.length_mm, limit_mm);
  compare("planarity_mm", shape.planarity_mm, limit_mm);
  compare("coincidence_mm", shape.coincidence_mm, limit_mm);
  compare("diagonal_mm", report.diagonal_mm, limit_mm);
  compare("angle_deg", shape.angle_deg, limit_deg);
  compare("beyond_deg", shape.beyond_deg, solver::kOverFoldBand_deg);
  if (shape.wrong_sign >= 0) {
    const solver::FoldLine& fold = panels_.folds[static_cast<std::size_t>(shape.wrong_sign)];
    report.findings.push_back(schema::differs(where, "fold " + solver::line_label(fold.a, fold.b),
                                              fold.sign > 0 ? "valley" : "mountain", "the other"));
  }
}

}  // namespace misalign::search
