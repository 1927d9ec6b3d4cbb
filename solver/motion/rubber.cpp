#include "solver/motion/rubber.hpp"

#include <cassert>

#include "solver/fill/edge_forces.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;

constexpr double kEquivalent = 0.95;  // of G t

PlateState state_of(const Filling& filling, Index hole, const HoleCorners& corners_mm) {
  const Eigen::Vector3d first_mm = corners_mm.col(2) - corners_mm.col(0),
                        second_mm = corners_mm.col(3) - corners_mm.col(1);
  const HoleShape shape{first_mm.squaredNorm(), second_mm.squaredNorm(), first_mm.dot(second_mm)};
  PlateState state{filling.plate(hole).stretches(shape), {}};
  const auto forces_n =
      edge_forces_n(filling.hole(hole, {first_mm.norm(), second_mm.norm()}), corners_mm);
  for (int k = 0; k < 4; ++k) {
    const double edge_mm = (corners_mm.col((k + 1) % 4) - corners_mm.col(k)).norm();
    state.edge_n_per_mm[static_cast<std::size_t>(k)] = forces_n.col(k).norm() / edge_mm;
  }
  return state;
}

void keep_largest(double value, double pilot_deg, PlateWay::Largest& largest) {
  if (value > largest.value) largest = {value, pilot_deg};
}

}  // namespace

StudyResult<RubberStudy> study_rubber(const Sheet& sheet, const RubberOptions& options) {
  if (options.from_deg) {
    if (const auto fault = beyond_d(sheet, *options.from_deg)) return *fault;
  }
  if (options.plates.rest_deg != 0 && !sheet.way()) return NoResult::path_lost;
  const Filling filling = filling_of(sheet, options.plates);
  Index rows = sheet.rows_up_to_d();
  if (options.from_deg) {
    const std::optional<Index> row = sheet.row_at(*options.from_deg);
    assert(row);
    rows = *row + 1;
  }
  RubberStudy study{
      options, {0}, {}, kEquivalent * options.plates.shear_mpa * options.plates.thickness_mm};
  for (Index row = 0; row < rows; ++row) {
    study.pilot_deg.push_back(sheet.history().stations[static_cast<std::size_t>(row)].pilot_deg);
  }
  Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, sheet.vertices_mm().cols());
  flat_mm.topRows<2>() = sheet.vertices_mm();
  for (Index h = 0; h < filling.holes(); ++h) {
    const int loop = sheet.mechanism().diagonals[static_cast<std::size_t>(2 * h)].loop;
    PlateWay plate{.facet = sheet.mechanism().loops[static_cast<std::size_t>(loop)].hole,
                   .corners = sheet.mechanism().hole_corners(static_cast<int>(h)),
                   .states = {},
                   .stretch = {0, 0},
                   .edge_n_per_mm = {0, 0}};
    for (std::size_t row = 0; row < study.pilot_deg.size(); ++row) {
      const Eigen::Matrix3Xd& at_mm = row == 0 ? flat_mm : sheet.shapes_mm()[row - 1];
      plate.states.push_back(state_of(filling, h, at_mm(Eigen::all, plate.corners)));
      const PlateState& state = plate.states.back();
      keep_largest(state.stretches.largest, study.pilot_deg[row], plate.stretch);
      for (const double edge : state.edge_n_per_mm) {
        keep_largest(edge, study.pilot_deg[row], plate.edge_n_per_mm);
      }
    }
    study.plates.push_back(std::move(plate));
  }
  return study;
}

}  // namespace misalign::solver
