#include "schema/exchange/stock_choice_json.hpp"

#include <algorithm>
#include <map>

#include "schema/exchange/actuators_json.hpp"
#include "schema/exchange/spring_faces_json.hpp"
#include "schema/files/json_values.hpp"
#include "schema/pattern/fill_json.hpp"

namespace misalign::schema {
namespace {

Json stock_limits_json(const solver::Mechanism& mechanism, const solver::StockOptions& options) {
  return {
      {"to_deg", options.to_deg},
      {"required_n_mm_per_mm", options.required_n_mm_per_mm},
      {"pushes", options.pushes},
      {"link_step_mm", options.links.step_mm},
      {"least_link_mm", options.links.least_mm},
      {"largest_force_n", or_null(options.links.largest_force_n)},
      {"never_both", pairs_json(mechanism, options.never_both)},
      {"barred", json_list(options.barred, [&](int d) { return diagonal_label(mechanism, d); })},
      {"goal", options.goal == solver::StockGoal::fewest_types ? "types" : "price"}};
}

Json stocked_json(const solver::Mechanism& mechanism, const SpringOrder& order,
                  const solver::StockedSpring& spring) {
  return {{"diagonal", diagonal_label(mechanism, spring.diagonal)},
          {"type", utf8(order.row_of(spring).name)},
          {"link_mm", spring.link_mm},
          {"least_mm", spring.least_mm},
          {"most_mm", spring.most_mm},
          {"largest_force_n", spring.largest_force_n}};
}

}  // namespace

std::optional<double> SpringOrder::static_margin() const {
  if (!choice.drives() || friction_n_mm_per_mm <= 0) return {};
  return bent_n_mm_per_mm.value_or(choice.static_n_mm_per_mm) / friction_n_mm_per_mm - 1;
}

double SpringOrder::outer_mm() const {
  double largest_mm = 0;
  for (const solver::StockedSpring& spring : choice.springs) {
    largest_mm = std::max(largest_mm, row_of(spring).spring.outer_mm);
  }
  return largest_mm;
}

Design SpringOrder::design_with(const Design& design, const solver::PerforatedSheet& base,
                                const solver::Mechanism& mechanism) const {
  Design with = design;
  static_cast<DesignFill&>(with) = design_of(choice.filling(mechanism, springs_of(table)), base);
  with.stroke_limit = design.stroke_limit;
  with.largest_force_n = design.largest_force_n;
  with.diameter_mm = outer_mm();
  return with;
}

std::vector<EqualSprings> equal_springs(const SpringOrder& order) {
  std::map<std::pair<int, double>, std::vector<solver::StockedSpring>> groups;
  for (const solver::StockedSpring& spring : order.choice.springs) {
    groups[{spring.type, spring.link_mm}].push_back(spring);
  }
  std::vector<EqualSprings> equal;
  for (const auto& [key, springs] : groups) equal.push_back({key.first, key.second, springs});
  return equal;
}

Json spring_order_json(const solver::PerforatedSheet& base, const solver::Mechanism& mechanism,
                       const SpringOrder& order) {
  const solver::StockChoice& choice = order.choice;
  const bool drives = choice.drives();
  Json groups = Json::array();
  for (const EqualSprings& group : equal_springs(order)) {
    groups.push_back(
        {{"spring", spring_row_json(order.table[static_cast<std::size_t>(group.type)])},
         {"link_mm", group.link_mm},
         {"count", group.springs.size()},
         {"diagonals", json_list(group.springs, [&](const auto& spring) {
            return diagonal_label(mechanism, spring.diagonal);
          })}});
  }
  const auto if_driven = [&](double value) { return drives ? Json(value) : Json(); };
  return {{"from_deg", choice.from_deg},
          {"limits", stock_limits_json(mechanism, choice.options)},
          {"drives", drives},
          {"is_proven", choice.is_proven},
          {"price", if_driven(choice.price)},
          {"static_friction_n_mm_per_mm", if_driven(choice.static_n_mm_per_mm)},
          {"weakest_deg", if_driven(choice.weakest_deg)},
          {"bent_static_friction_n_mm_per_mm", or_null(order.bent_n_mm_per_mm)},
          {"static_margin", or_null(order.static_margin())},
          {"wanted_margin", order.wanted_margin},
          {"bound_n_mm_per_mm", drives ? Json() : Json(choice.bound_n_mm_per_mm)},
          {"groups", groups},
          {"springs", json_list(choice.springs,
                                [&](const solver::StockedSpring& spring) {
                                  return stocked_json(mechanism, order, spring);
                                })},
          {"way", order.way ? spring_faces_json(mechanism, *order.way) : Json()},
          {"fill", drives ? fill_json(order.design_with({}, base, mechanism)) : Json()},
          {"effort", {{"nodes", choice.nodes}, {"pivots", choice.pivots}}}};
}

}  // namespace misalign::schema
