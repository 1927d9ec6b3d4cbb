// Writes springs to buy for a sheet as JSON and as a list of equal ones.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/pattern/design.hpp"
#include "schema/pattern/spring_table.hpp"
#include "solver/contact/spring_faces.hpp"
#include "solver/fitting/stock_choice.hpp"

namespace misalign::schema {

/// Springs of a table for one sheet.
struct SpringOrder {
  std::vector<SpringRow> table;
  solver::StockChoice choice;
  double friction_n_mm_per_mm = 0;  ///< dry friction of the creases
  double wanted_margin = 0;         ///< static margin to have over it
  /// Static friction overcome while panels bend; none where this was not studied.
  std::optional<double> bent_n_mm_per_mm;
  /// Faces and order of the springs; none where the sheet does not deploy from the angle of use.
  std::optional<solver::SpringFaces> way = {};

  const SpringRow& row_of(const solver::StockedSpring& spring) const {
    return table[static_cast<std::size_t>(spring.type)];
  }
  /// Static friction over the friction of the creases, less 1, with bending panels where these were
  /// studied; none without friction.
  std::optional<double> static_margin() const;
  /// The largest outer diameter; 0 where nothing is bought.
  double outer_mm() const;
  /// The design with these springs, whose diameter is the largest.
  Design design_with(const Design& design, const solver::PerforatedSheet& base,
                     const solver::Mechanism& mechanism) const;
};

/// Springs of one type with links of one length.
struct EqualSprings {
  int type;
  double link_mm;
  std::vector<solver::StockedSpring> springs;  ///< ascending diagonals
};
/// Returns the groups by type, then by length.
std::vector<EqualSprings> equal_springs(const SpringOrder& order);

/// The choice, what it costs, equal springs, each spring, and "fill" as a design takes it, null
/// where no springs drive the sheet.
Json spring_order_json(const solver::PerforatedSheet& base, const solver::Mechanism& mechanism,
                       const SpringOrder& order);

}  // namespace misalign::schema
