#include "schema/exchange/optimise_json.hpp"

#include "schema/exchange/actuators_json.hpp"
#include "schema/files/json_values.hpp"
#include "solver/records/strokes.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::schema {

const char* name_of(solver::Optimised::StopReason reason) {
  return reason == solver::Optimised::StopReason::most_steps ? "most_steps" : "no_step_is_better";
}

Json limits_json(const solver::Mechanism& mechanism, const solver::OptimiseOptions& options,
                 const solver::Optimised::Limits& limits) {
  Json turning = Json::array(), floors = Json::object();
  for (const auto& [diagonal, pilot_deg, per_mm] : limits.turning) {
    turning.push_back({{"diagonal", diagonal_label(mechanism, diagonal)},
                       {"pilot_deg", pilot_deg},
                       {"per_mm", per_mm}});
  }
  for (std::size_t k = 0; k < options.floors.size(); ++k) {
    floors[std::string(options.floors[k].goal->name)] = limits.per_floor[k];
  }
  Json json = {{"per_share_of_stroke", limits.per_share_of_stroke},
               {"per_n_of_force", limits.per_n_of_force},
               {"per_mm_of_amplitude", limits.per_mm_of_amplitude},
               {"per_1_of_floors", floors},
               {"turning", turning},
               {"energy_deg", or_null(limits.energy_deg)},
               {"fold_limit", limits.by_fold_limit}};
  if (options.stiffness_n_per_mm) {
    json["per_n_per_mm_of_stiffness"] = limits.per_n_per_mm_of_stiffness;
  }
  if (options.preload_n) json["per_n_of_preload"] = limits.per_n_of_preload;
  return json;
}

namespace {

// The range and the chosen value of a spring's property.
Json chosen_json(const std::optional<solver::OptimiseOptions::Range>& range, double chosen) {
  return range ? Json{{"within", {range->least, range->most}}, {"chosen", chosen}} : Json();
}

}  // namespace

Json optimise_json(const solver::Sheet& sheet, const solver::Optimised& found,
                   std::optional<double> certified_deg, const Json& pattern) {
  const solver::OptimiseOptions& options = found.options;
  const solver::Goal& goal = *options.goal;
  Json json = {
      {"goal", goal.name},
      {"from_deg", found.from_deg},
      {std::string("before_") + goal.unit, goal.in_unit(found.start().value)},
      {std::string("after_") + goal.unit, goal.in_unit(found.best().value)},
      {"amplitude_mm", options.amplitude_mm},
      {"ternary", options.ternary},
      {"grid_mm", options.grid_mm > 0 ? Json(options.grid_mm) : Json()},
      {"within_family", options.moves.size() > 0},
      {"stroke_limit", or_null(options.stroke_limit)},
      {"largest_force_n", or_null(options.largest_force_n)},
      {"stiffness_n_per_mm",
       chosen_json(options.stiffness_n_per_mm, found.best().stiffness_n_per_mm)},
      {"preload_n", chosen_json(options.preload_n, found.best().preload_n)},
      {"subject_to", bounds_json({options.stroke_limit, options.largest_force_n, options.floors})},
      {"steps", found.steps()},
      {"sheets_folded", found.evaluations},
      {"end", name_of(found.stop_reason)},
      {"asked_deg", sheet.sample_deg(options.deploys_from_sample)},
      {"deploys_from_deg", sheet.deploys_from_deg()},
      {"certified_deg", or_null(certified_deg)},
      {"used_from_deg", solver::angle_of_use(sheet, options.used_from_deg)},
      {"stroke",
       solver::largest_stroke(sheet.history(), solver::rows_of_use(sheet, options.used_from_deg))},
      {"limits", nullptr},
      {"pattern", pattern}};
  if (found.limits) json["limits"] = limits_json(sheet.mechanism(), options, *found.limits);
  return json;
}

}  // namespace misalign::schema
