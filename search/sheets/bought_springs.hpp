// Chooses springs to buy for a sheet by the requirements of its design.
#pragma once

#include <optional>
#include <string>

#include "schema/exchange/stock_choice_json.hpp"
#include "search/sheets/chosen_sheet.hpp"

namespace misalign::search {

/// Springs to buy, as typed: a table, and options that no design has.
struct BuyInput {
  std::vector<schema::SpringRow> table = schema::common_springs();
  solver::LinkLimits links = {};
  bool pushes = false;
  solver::StockGoal goal = solver::StockGoal::fewest_types;
};

/// Returns the objective named "types" or "price"; none for other words.
std::optional<solver::StockGoal> goal_of_purchase(const std::string& name);

/// Springs with the static margin of the design over its friction, down to its margin_to_deg, with
/// panels that bend where the design gives their thickness; without friction the energy falls. No
/// two touch each other, none touches a panel, and none exceeds the design's largest force.
schema::SpringOrder bought_springs(const solver::Sheet& sheet, const schema::Design& design,
                                   const BuyInput& input);

/// The sheet's pattern file with these springs as its design's filling.
schema::Json bought_pattern(const Subject& subject, const schema::SpringOrder& order);

}  // namespace misalign::search
