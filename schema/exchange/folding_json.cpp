#include "schema/exchange/folding_json.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "schema/campaign/campaign_file.hpp"
#include "schema/files/json_values.hpp"
#include "schema/pattern/fill_json.hpp"
#include "schema/pattern/judging_fill.hpp"
#include "solver/sheet/energy_history.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::schema {
namespace {

Json diagonals_json(const FoldingView& view, bool histories) {
  Json list = Json::array();
  for (int d = 0; d < view.mechanism.diagonal_count(); ++d) {
    list.push_back(diagonal_json(view.base, view.mechanism, view.mechanism.diagonals[d],
                                 view.history.flat_mm[d]));
    list.back()["diagonal"] = d;
    if (histories) {
      list.back()["length_mm"] = json_list(view.history.length_mm.col(d), std::identity());
      list.back()["slope_mm_per_deg"] =
          json_list(view.history.slope_mm_per_deg.col(d), std::identity());
    }
  }
  return list;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

}  // namespace

Json verdict_json(const FoldingView& view) {
  const solver::Verdict& verdict = view.history.verdict;
  const int fault_sample = verdict.fault_sample();
  const std::string where = where_label(view.mechanism, verdict);
  Json json = {{"deploys_from_deg", verdict.deploys_from_sample * view.sample_deg},
               {"first_fault", solver::fault_name(verdict.first_fault)},
               {"fault_deg", fault_sample > 0 ? Json(fault_sample * view.sample_deg) : Json()},
               {"where", where.empty() ? Json() : Json(where)}};
  if (verdict.first_fault == solver::Fault::undecided) json["cause"] = undecided_cause(verdict);
  return json;
}

Json bump_json(const FoldingView& view) {
  const solver::Between& between = view.history.between;
  if (between.bump_where < 0) return Json();
  const solver::Diagonal& diagonal = view.mechanism.diagonals[between.bump_where];
  return {{"from_deg", between.bump_deg},
          {"where", solver::line_label(diagonal.from, diagonal.to)}};
}

Json energy_json(const FoldingView& view, const solver::Fill& fill) {
  if (!drives_to_flat(fill)) return Json();
  const solver::EnergyHistory energy = solver::energy_history(view.sheet, view.history, fill);
  const double d_deg = energy.deploys_from_sample * view.sample_deg;
  Json json = {{"fill", fill_json(fill, view.base.base)},
               {"deploys_from_deg", d_deg},
               {"diagonals_deploy_from_deg", energy.monotone_to_sample * view.sample_deg},
               {"energy_n_mm", energy.energy_n_mm}};
  const bool falls = !energy.rises_to_the_end;
  json["first_fault"] = falls ? Json(solver::fault_name(solver::Fault::energy_rises)) : Json();
  json["fault_deg"] = falls ? Json(d_deg + view.sample_deg) : Json();
  json["where"] = Json();
  if (energy.where >= 0) {
    const solver::Diagonal& diagonal = view.mechanism.diagonals[energy.where];
    json["where"] = solver::line_label(diagonal.from, diagonal.to);
  }
  return json;
}

std::optional<double> off_target_mm(const FoldingView& view) {
  const std::optional<FoldedTarget>& target = view.base.folded_target;
  const solver::FoldingWay* const way = target ? view.sheet.way() : nullptr;
  if (!way || target->pilot_deg > way->end_deg()) return {};
  const Eigen::Matrix3Xd& found_mm = view.sheet.at(target->pilot_deg).vertices_mm;
  const Eigen::Isometry3d onto(Eigen::umeyama(found_mm, target->vertices_mm, false));
  return (onto * found_mm - target->vertices_mm).colwise().norm().maxCoeff();
}

std::optional<solver::HeldRest> held_at_target(const FoldingView& view, const solver::Fill& fill) {
  const std::optional<FoldedTarget>& target = view.base.folded_target;
  if (!off_target_mm(view) || solver::rest_deg(fill) != target->pilot_deg) return {};
  const solver::FoldingWay& way = *view.sheet.way();
  return solver::held_rest(way, solver::filling_on(way, fill), target->pilot_deg);
}

Json target_json(const FoldingView& view, const solver::Fill& fill) {
  const auto held = held_at_target(view, fill);
  if (!held) return {};
  return {{"rest_deg", view.base.folded_target->pilot_deg},
          {"driven_from_deg", held->driven_from_deg},
          {"driven_from_below_deg", held->driven_from_below_deg},
          {"barrier_n_mm", held->barrier_n_mm},
          {"barrier_deg", held->barrier_deg},
          {"shape_off_mm", *off_target_mm(view)}};
}

Json folding_json(const FoldingView& view) {
  const solver::FoldingHistory& history = view.history;
  Json creases = Json::array();
  for (std::size_t i = 0; i < view.mechanism.creases.size(); ++i) {
    const solver::Crease& crease = view.mechanism.creases[i];
    creases.push_back(
        {{"crease", i},
         {"from", solver::vertex_label(crease.a)},
         {"to", solver::vertex_label(crease.b)},
         {"assignment", view.mechanism.is_valley(crease) ? "valley" : "mountain"},
         {"fold_angle_deg",
          json_list(history.fold_angle_deg.col(static_cast<Eigen::Index>(i)), std::identity())}});
  }
  return {{"pattern", pattern_json(view.base, view.shifts_mm)},
          {"mesh_off_mm", view.base.mesh_off_mm},
          {"unknowns", view.mechanism.unknowns},
          {"equations", view.mechanism.equations},
          {"degrees_of_freedom", 1},  // other sheets are refused
          {"verdict", verdict_json(view)},
          {"bump_between_samples", bump_json(view)},
          {"fold_limit_deg", history.path.fold_limit_deg},
          {"samples_deg", json_list(history.stations, &solver::Station::pilot_deg)},
          {"diagonals", diagonals_json(view, true)},
          {"creases", creases},
          {"residual_max", largest(history.open_by)},
          {"isometry_error_mm", largest(history.isometry_error_mm)},
          {"smallest_singular_value", history.singular_value_min}};
}

Json folded_pattern_json(const Sampling& sampling, const FoldingView& view, const Json& actuation,
                         const Json& deployment) {
  const solver::Metrics* const metrics = view.sheet.metrics();
  Json diagonals = diagonals_json(view, false);
  for (std::size_t d = 0; d < diagonals.size(); ++d) {
    diagonals[d]["elongation"] = metrics ? Json(metrics->elongation[d]) : Json();
  }
  return {{"pattern", pattern_json(view.base, view.shifts_mm)},
          {"sampling", sampling_json(sampling)},
          {"verdict", verdict_json(view)},
          {"metrics", metrics ? metrics_json(*metrics) : Json()},
          {"diagonals", diagonals},
          {"actuation", actuation},
          {"deployment", deployment}};
}

Json origin_json(const Campaign& campaign, std::uint64_t draw, const Json& yields) {
  return {{"campaign", {{"name", campaign.name}, {"identity", identity(campaign)}}},
          {"draw", draw},
          {"yields", yields}};
}

}  // namespace misalign::schema
