#include "search/checks/candidate_check.hpp"

#include <algorithm>
#include <cmath>

#include "schema/exchange/folding_json.hpp"
#include "schema/files/json_values.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "schema/pattern/target.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/models.hpp"
#include "search/sheets/campaign_sheet.hpp"
#include "search/sheets/optimised_draw.hpp"
#include "solver/model/miscut_margin.hpp"
#include "solver/optimise/objective.hpp"
#include "solver/optimise/optimise.hpp"
#include "solver/target/shape_measure.hpp"

namespace misalign::search {
using schema::Json;

namespace {

// Compares objective values and prices of limits with those of another build.
bool agrees(const Json& a, const Json& b) {
  constexpr double kAgree = 1e-6, kNothing = 1e-12;
  if (a.is_number() && b.is_number()) {
    const double x = a.get<double>(), y = b.get<double>();
    return std::abs(x - y) <= kAgree * std::max(std::abs(x), std::abs(y)) + kNothing;
  }
  if (a.is_array() && b.is_array()) return std::ranges::equal(a, b, agrees);
  if (!a.is_object() || !b.is_object()) return a == b;
  for (const auto& [key, value] : a.items()) {
    if (!b.contains(key) || !agrees(value, b.at(key))) return false;
  }
  return a.size() == b.size();
}

}  // namespace

Json ascent_row(const schema::AscentRecord& ascent) {
  return {{"start_value", schema::or_null(ascent.start_value)},
          {"end_value", schema::or_null(ascent.end_value)},
          {"steps", ascent.steps},
          {"sheets_folded", ascent.sheets_folded},
          {"ended", ascent.ended},
          {"limited_by", schema::or_null(ascent.limited_by)}};
}

void compare_ascents(
    const Json& stored, const Json& other,
    const std::function<void(const std::string&, const Json&, const Json&)>& differ) {
  static const Json kColumns = ascent_row({});
  for (const auto& [column, nothing] : kColumns.items()) {
    const auto cell = [&name = column](const Json& row) {
      const Json value = row.is_object() ? row.value(name, Json()) : Json();
      return name == "limited_by" && value.is_string() ? schema::json_of(value) : value;
    };
    if (!agrees(cell(stored), cell(other))) {
      differ("ascent." + column, cell(stored), cell(other));
    }
  }
}

CandidateCheck::CandidateCheck(const schema::Campaign& campaign)
    : campaign_(campaign), sheets_(campaign) {
  if (!campaign.search.has_ends()) return;
  if (campaign.search.optimisation) asked_ = asked_of_ends(campaign);
  model_.reset(new solver::Model(model_of(campaign)));
}

solver::Verdict CandidateCheck::verdict(std::uint64_t draw) const {
  return sheets_.sheet(shifts_of_draw(campaign_, draw)).history().verdict;
}

CandidateReport CandidateCheck::check(const Json& row, int metrics_version) const {
  CandidateReport report;
  const auto cell = [&](const char* column) {
    return row.is_object() ? row.value(column, Json()) : Json();
  };
  if (!cell("draw").is_number_integer()) {
    report.findings.push_back(
        schema::differs("a candidate", "draw", cell("draw"), "the number of its draw"));
    return report;
  }
  const auto draw = row.at("draw").get<std::uint64_t>();
  const std::string where = "draw " + std::to_string(draw);
  const auto differs = [&](const std::string& column, const Json& stored, const Json& recomputed) {
    report.findings.push_back(schema::differs(where, column, stored, recomputed));
  };
  const solver::PerforatedSheet& base = campaign_.pattern.base;
  const auto shifts_mm = schema::read_shifts(cell("displacements_mm"), base.sheet.vertex_count());
  if (campaign_.search.stores_sheets()) {  // their sheets are recomputed with --units alone
    if (!shifts_mm || !can_be_kept(campaign_, *shifts_mm)) {
      differs("displacements_mm", cell("displacements_mm"), "shifts of the campaign");
    }
  } else if (const Eigen::Matrix2Xd drawn_mm = shifts_of_draw(campaign_, draw);
             !shifts_mm || *shifts_mm != drawn_mm) {
    differs("displacements_mm", cell("displacements_mm"),
            schema::displacements_json(drawn_mm).dump());
  }
  if (!shifts_mm) return report;
  const solver::Sheet sheet = sheets_.sheet(*shifts_mm);
  if (!solver::nonconvex_facets(base.sheet, sheet.vertices_mm()).empty()) {
    if (report.findings.empty()) {
      differs("displacements_mm", cell("displacements_mm"), "shifts that leave every facet convex");
    }
    return report;
  }

  const int recomputed_sample = sheet.history().verdict.deploys_from_sample;
  if (recomputed_sample == 0) {
    differs("deploys_from_sample", cell("deploys_from_sample"), 0);
    return report;
  }
  check_metrics(row, metrics_version, *sheet.metrics(), report);
  sheets_.check_shapes(where, sheet, recomputed_sample, report);
  return report;
}

void CandidateCheck::check_ascent(const Json& row, const Json& ascent,
                                  CandidateReport& report) const {
  const auto shifts_mm = schema::read_shifts(row.value("displacements_mm", Json()),
                                             campaign_.pattern.base.sheet.vertex_count());
  if (!shifts_mm || !ascent.is_object()) return;  // a finding of check()
  const auto draw = row.at("draw").get<std::uint64_t>();
  const auto differs = [&](const std::string& column, const Json& stored, const Json& recomputed) {
    report.findings.push_back(
        schema::differs("draw " + std::to_string(draw), column, stored, recomputed));
  };
  solver::SheetSolver solver(*model_);
  const auto compare = [&](const char* column, const Json& recomputed) {
    const Json stored = ascent.value(column, Json());
    if (!agrees(stored, recomputed)) differs(std::string("ascent.") + column, stored, recomputed);
  };
  const solver::Sheet end(solver, *shifts_mm);
  if (campaign_.search.shape) {
    const auto measure =
        solver::ShapeMeasure::of(solver, campaign_.target->shape, *campaign_.target->at_deg);
    const auto off_of = [&](const solver::Sheet& sheet) {
      return measure ? measure->fitted(sheet) : std::nullopt;
    };
    const auto off = off_of(end), at_start = off_of({solver, shifts_of_draw(campaign_, draw)});
    compare("start_value", at_start ? Json(at_start->rms_mm()) : Json());
    compare("end_value", off ? Json(off->rms_mm()) : Json());
    const double most_mm = campaign_.search.shape->shape_max_mm;
    if (off && off->max_mm() > most_mm * (1 + 1e-9)) {
      differs("shape_max_mm", most_mm, off->max_mm());
    }
    return;
  }
  const bool is_as_drawn = ascent.value("steps", Json()) == 0;
  if (!is_as_drawn) compare("end_value", schema::or_null(solver::objective(end, *asked_)));
  if (campaign_.search.splitting) return;  // its start is recomputed with --units alone
  if (!campaign_.accepts(verdict(draw))) differs("verdict of the draw", "accepted", "rejected");
  const solver::Sheet start(solver, shifts_of_draw(campaign_, draw));
  // A grid's multiples may come from another product.
  constexpr double kSame_mm = 1e-12;
  if (is_as_drawn && (start.shifts_mm() - end.shifts_mm()).cwiseAbs().maxCoeff() > kSame_mm) {
    differs("displacements_mm", row.at("displacements_mm"),
            schema::displacements_json(start.shifts_mm()).dump());
  }
  const auto fitted = solver::fitted_start(start, *asked_);
  const Json value = fitted ? Json(fitted->start().value) : Json();
  compare("start_value", value);
  if (is_as_drawn) compare("end_value", value);
}

void CandidateCheck::check_metrics(const Json& row, int metrics_version,
                                   const solver::Metrics& metrics, CandidateReport& report) const {
  const std::string where = "draw " + row.at("draw").dump();
  const auto differs = [&](const std::string& column, const Json& stored, const Json& recomputed) {
    report.findings.push_back(schema::differs(where, column, stored, recomputed));
  };
  const Json recomputed = schema::metrics_json(metrics);
  for (const auto& [column, value] : recomputed.items()) {
    const schema::MetricAge age = schema::metric_age(column);
    const bool is_younger = metrics_version < age.first;  // null in such a column
    const Json stored = row.value(column, is_younger ? Json() : Json("no such column"));
    const Json expected = is_younger ? Json() : value;
    if (sheets_.tolerances().agree(column, stored, expected)) continue;
    if (!is_younger && metrics_version < age.present) {
      report.not_comparable.push_back(column);
    } else {
      differs(column, stored, expected);
    }
  }
  const std::string elongation = Json(metrics.elongation).dump();
  const Json stored_elongation = row.value("elongation", Json());
  if (!sheets_.tolerances().agree("elongation", stored_elongation, elongation)) {
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

}  // namespace misalign::search
