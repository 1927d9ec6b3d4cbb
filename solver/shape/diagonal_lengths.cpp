#include "solver/shape/diagonal_lengths.hpp"

namespace misalign::solver {

std::optional<DiagonalLengths> diagonal_lengths(const Sheet& sheet, double pilot_deg,
                                                PathGradients* gradients) {
  if (gradients) {
    auto there = gradients->at(pilot_deg, false);
    if (!there) return {};
    return DiagonalLengths{std::move(there->length_mm), std::move(there->length_by_mm)};
  }
  const FoldingWay& way = *sheet.way();
  if (pilot_deg == 0) return DiagonalLengths{way.flat_mm(), {}};
  DiagonalLengths lengths;
  Eigen::VectorXd rates;
  way.find_lengths(way.x_of(pilot_deg), lengths.mm, rates);
  return lengths;
}

}  // namespace misalign::solver
