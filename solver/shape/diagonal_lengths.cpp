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

double change_by_slope_mm(double slope_mm_per_deg, double from_deg, double to_deg) {
  const auto cosine = [](double angle_deg) {
    const auto half = half_angle_of_deg(angle_deg);
    return half.c * half.c - half.s * half.s;
  };
  return slope_mm_per_deg / kRadPerDeg * (cosine(from_deg) - cosine(to_deg));
}

}  // namespace misalign::solver
