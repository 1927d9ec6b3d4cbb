#include "schema/exchange/spring_choice_json.hpp"

#include "schema/exchange/actuators_json.hpp"
#include "schema/files/json_values.hpp"
#include "schema/pattern/fill_json.hpp"

namespace misalign::schema {
namespace {

Json rows_json(const solver::SpringChoice& choice) {
  Json rows = Json::array();
  for (const solver::DrivenPlace& place : choice.rows) {
    rows.push_back({{"pilot_deg", place.pilot_deg},
                    {"turning_mm", place.turning_mm},
                    {"length_mm", json_list(place.length_mm, std::identity())},
                    {"slope_mm", json_list(place.slope_mm, std::identity())}});
  }
  return rows;
}

Json limits_json(const solver::Mechanism& mechanism, const solver::SpringChoiceOptions& options) {
  return {{"to_deg", options.to_deg},
          {"most_rate_n_per_mm", options.most_rate_n_per_mm},
          {"rates_n_per_mm", options.rates_n_per_mm},
          {"free_within", options.free_within},
          {"pull_only", options.pull_only},
          {"one_a_hole", options.one_a_hole},
          {"never_both", pairs_json(mechanism, options.never_both)},
          {"most_springs", or_null(options.most_springs)},
          {"friction_n_mm_per_mm", options.friction_n_mm_per_mm},
          {"fewest_margin", or_null(options.fewest_margin)},
          {"equal_lengths_share", or_null(options.equal_lengths_share)}};
}

}  // namespace

Json spring_choice_json(const solver::PerforatedSheet& base, const solver::Mechanism& mechanism,
                        const solver::SpringChoice& choice) {
  const bool drives = choice.drives();
  Json weights = Json::array();
  for (const auto& [pilot_deg, weight] : choice.weights) {
    weights.push_back({{"pilot_deg", pilot_deg}, {"weight", weight}});
  }
  return {{"from_deg", choice.from_deg},
          {"limits", limits_json(mechanism, choice.options)},
          {"drives", drives},
          {"driven_from_deg", or_null(choice.driven_from_deg)},
          {"static_friction_n_mm_per_mm", choice.static_n_mm_per_mm},
          {"weakest_deg", choice.weakest_deg},
          {"static_margin", or_null(choice.static_margin)},
          {"bound_n_mm_per_mm", choice.bound_n_mm_per_mm},
          {"relaxed_n_mm_per_mm", choice.relaxed_n_mm_per_mm},
          {"proven_fewest", or_null(choice.proven_fewest)},
          {"fill", drives ? fill_json(solver::Fill(choice.filling(mechanism)), base) : Json()},
          {"effort",
           {{"programs", choice.programs}, {"pivots", choice.pivots}, {"nodes", choice.nodes}}},
          {"weights", weights},
          {"rows", rows_json(choice)}};
}

}  // namespace misalign::schema
