#include "solver/shape/well_rows.hpp"

#include <algorithm>
#include <cmath>

#include "solver/shape/diagonal_lengths.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

// Largest difference of a diagonal's lengths flat and at the shape, and the place between them
// where the barrier is asked for, as a share of the shape's angle.
constexpr double kSame_mm = 0.003, kBarrierAt = 2.0 / 3;
// A distance off rest below this has no direction.
constexpr double kAtRest_mm = 1e-9;

// s and its gradient.
struct OffRest {
  double mm;
  RowVectorXd by_mm;
};

OffRest off_rest(const DiagonalLengths& there, const DiagonalLengths& rest, Index coordinates) {
  const VectorXd off_mm = there.mm - rest.mm;
  const double mm = off_mm.norm();
  if (there.by_mm.size() == 0 || mm < kAtRest_mm) return {mm, RowVectorXd::Zero(coordinates)};
  return {mm, off_mm.transpose() * (there.by_mm - rest.by_mm) / mm};
}

}  // namespace

bool add_energy_rows(const Sheet& sheet, const ShapeOptions& options,
                     const std::vector<double>& angles_deg, PathGradients* gradients,
                     std::vector<ShapeRow>& rows) {
  const auto rest = diagonal_lengths(sheet, options.at_deg, gradients);
  if (!rest) return false;
  const Index coordinates = 2 * sheet.vertices_mm().cols();
  std::optional<OffRest> last;
  double last_deg = 0;
  const auto add = [&](double pilot_deg) {
    const auto there = diagonal_lengths(sheet, pilot_deg, gradients);
    if (!there) return false;
    const OffRest now = pilot_deg == options.at_deg ? OffRest{0, RowVectorXd::Zero(coordinates)}
                                                    : off_rest(*there, *rest, coordinates);
    if (last) {
      const double side = pilot_deg > options.at_deg ? 1 : -1;
      const double least_mm =
          change_by_slope_mm(options.least_slope_mm_per_deg, last_deg, pilot_deg);
      rows.push_back({ShapeRow::Kind::energy, 0, pilot_deg, side * (now.mm - last->mm) - least_mm,
                      gradients ? RowVectorXd(side * (now.by_mm - last->by_mm)) : RowVectorXd()});
    }
    last = now;
    last_deg = pilot_deg;
    return true;
  };
  if (!add(0)) return false;
  for (const double angle_deg : angles_deg) {
    if (angle_deg >= sheet.way()->end_deg() - 0.01) break;
    if (last_deg < options.at_deg && angle_deg > options.at_deg && !add(options.at_deg)) {
      return false;
    }
    if (!add(angle_deg)) return false;
  }
  return true;
}

std::vector<double> energy_turns_deg(const Sheet& sheet, double at_deg, double to_deg) {
  const FoldingWay& way = *sheet.way();
  VectorXd rest_mm, lengths_mm, rates;
  way.find_lengths(way.x_of(at_deg), rest_mm, rates);
  const auto off_mm = [&](double pilot_deg) {
    way.find_lengths(way.x_of(pilot_deg), lengths_mm, rates);
    return (lengths_mm - rest_mm).norm();
  };
  std::vector<double> turns_deg;
  double last_deg = 0, last_mm = (way.flat_mm() - rest_mm).norm();
  while (last_deg < to_deg) {
    double next_deg = std::min(std::floor(last_deg + 1 + kSameAngle_deg), to_deg);
    if (last_deg < at_deg && next_deg > at_deg) next_deg = at_deg;
    const double mm = off_mm(next_deg);
    if (next_deg > at_deg ? mm <= last_mm : mm >= last_mm) turns_deg.push_back(next_deg);
    last_deg = next_deg;
    last_mm = mm;
  }
  return turns_deg;
}

bool add_bistable_rows(const Sheet& sheet, const ShapeOptions& options, PathGradients* gradients,
                       std::vector<ShapeRow>& rows) {
  const auto flat = diagonal_lengths(sheet, 0, gradients),
             shape = diagonal_lengths(sheet, options.at_deg, gradients);
  if (!flat || !shape) return false;
  for (Index d = 0; d < flat->mm.size(); ++d) {
    for (const double side : {1.0, -1.0}) {
      RowVectorXd row;
      if (gradients) row = side * (shape->by_mm.row(d) - flat->by_mm.row(d));
      rows.push_back({ShapeRow::Kind::equal, static_cast<int>(d), options.at_deg,
                      kSame_mm + side * (shape->mm(d) - flat->mm(d)), std::move(row)});
    }
  }
  if (options.barrier_mm <= 0) return true;
  for (const double angle_deg : {kBarrierAt * options.at_deg, options.from_deg}) {
    if (angle_deg >= sheet.way()->end_deg() - 0.01) continue;
    const auto there = diagonal_lengths(sheet, angle_deg, gradients);
    if (!there) return false;
    OffRest off = off_rest(*there, *flat, 2 * sheet.vertices_mm().cols());
    rows.push_back({ShapeRow::Kind::barrier, 0, angle_deg, off.mm - options.barrier_mm,
                    gradients ? std::move(off.by_mm) : RowVectorXd()});
  }
  return true;
}

}  // namespace misalign::solver
