// Single changes of a sheet or its design, and the requirements of a card that each may meet.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "schema/exchange/card_json.hpp"
#include "solver/studies/goal.hpp"

namespace misalign::search {

/// Keys of requirements.
using CardKeys = std::vector<std::string_view>;

/// A number of the design that is changed by factors.
struct NumberChange {
  enum class Way { up, down, both };

  std::optional<double> schema::Design::*number;
  double usual;   ///< the start where the design has none, or 0; 0: the design must name one
  double factor;  ///< the first change, above 1
  Way way;
  const char* what;  ///< a format of the value
  CardKeys mends;    ///< requirements for which it is sought
  /// Requirements that compare it with the actual value, and margins over it.
  CardKeys limited_by = {}, margins = {};
  /// A choice that goes with it; null: none.
  void (*also)(schema::Design& design) = nullptr;
  const char* also_typed = "";
};
std::span<const NumberChange> number_changes();

/// A choice of the design that is made or not.
struct SwitchChange {
  void (*make)(schema::Design& design);
  const char *what, *typed;
  double cost;  ///< comparable to logarithms of factors
  CardKeys mends;
};
std::span<const SwitchChange> switch_changes();

/// Returns whether other shifts may meet the requirement.
bool is_mended_by_shifts(std::string_view key);
/// The goal of an optimisation towards the requirement; null: none.
const char* goal_towards(std::string_view key);
/// Bounds by which an optimisation keeps the requirements that a card meets, where goals are their
/// values. `friction`: the hinges', N mm/mm.
std::vector<solver::OptimiseFloor> kept_floors(const schema::Card& card, double friction);

}  // namespace misalign::search
