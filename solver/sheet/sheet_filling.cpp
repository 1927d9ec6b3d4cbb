#include "solver/sheet/sheet_filling.hpp"

#include <cassert>

namespace misalign::solver {
namespace {

using Eigen::VectorXd;

VectorXd lengths_at_mm(const FoldingWay& way, double pilot_deg) {
  if (pilot_deg == 0) return way.flat_mm();
  VectorXd lengths_mm, rates;
  way.find_lengths(way.x_of(pilot_deg), lengths_mm, rates);
  return lengths_mm;
}

}  // namespace

VectorXd sides_of_diagonals(const FoldingWay& way) {
  VectorXd lengths_mm, rates;
  way.find_lengths(way.x_of_station(0), lengths_mm, rates);
  return (lengths_mm - way.flat_mm()).cwiseSign();
}

Filling filling_on(const FoldingWay& way, const Fill& fill) {
  const Mechanism& mechanism = way.mechanism();
  HoleDiagonals holes{way.flat_mm(), lengths_at_mm(way, rest_deg(fill)), sides_of_diagonals(way),
                      diagonal_products_mm2(mechanism, way.from_a1_mm())};
  if (const auto* const springs = std::get_if<Springs>(&fill)) {
    for (const auto& [diagonal, rest_deg] : springs->other_rests_deg) {
      assert(diagonal >= 0 && diagonal < holes.rest_mm.size());
      holes.rest_mm(diagonal) = lengths_at_mm(way, rest_deg)(diagonal);
    }
  }
  return {fill, mechanism.diagonals, holes};
}

Filling filling_of(const Sheet& sheet, const Fill& fill) {
  const auto* const springs = std::get_if<Springs>(&fill);
  if (rest_deg(fill) != 0 || (springs && !springs->other_rests_deg.empty())) {
    assert(sheet.way());
    return filling_on(*sheet.way(), fill);
  }
  const FoldingHistory& history = sheet.history();
  const VectorXd flat_mm = VectorXd::Map(history.flat_mm.data(), std::ssize(history.flat_mm));
  VectorXd sides = VectorXd::Zero(flat_mm.size());
  if (history.length_mm.rows() > 0) {
    sides = (history.length_mm.row(0).transpose() - flat_mm).cwiseSign();
  }
  return {fill,
          sheet.mechanism().diagonals,
          {flat_mm, flat_mm, sides, diagonal_products_mm2(sheet.mechanism(), sheet.vertices_mm())}};
}

}  // namespace misalign::solver
