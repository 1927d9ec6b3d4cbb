#include "solver/model/model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "solver/linear/pivot_order.hpp"
#include "solver/model/miscut_margin.hpp"
#include "solver/model/rejection_tolerances.hpp"

namespace misalign::solver {
namespace {

// Largest pilot angle of the far place, of 180 degrees, in proportion if the base folding ends
// earlier. One step from there leads 99 of 100 sheets of 6 x 6 to their own path, and no sheet that
// deploys to another; at 165 degrees one of 35 was lost (results/level.md).
constexpr double kSafeFromBase_deg = 157.5;

// Distance of the far place below the threshold, since pilots differ at one level.
constexpr double kPilotsDiffer_deg = 2;

// Places as shares of the far one. After a test at the far level, one at a smaller share shows in
// which direction diagonals set out: the two decide nine of ten sheets.
constexpr double kPlaces[] = {1, 0.95, 0.9, 0.85, 0.8, 0.6, 0.4, 0.2};
static_assert(std::size(kPlaces) == Model::kNear + 1);

// Least angle of the far place: closer to flat nothing is gained.
constexpr double kLeastFar_deg = 1;

// Groups the unknowns without the pilot such that no loop has two of a group: a diagonal depends on
// the joints of its own loop alone, so that one evaluation serves a group.
std::vector<std::vector<int>> apart_from_each_other(
    const Mechanism& mechanism, const std::vector<std::vector<int>>& unknowns_of_loop) {
  std::vector<std::vector<int>> loops_of(mechanism.unknowns), groups;
  for (std::size_t loop = 0; loop < unknowns_of_loop.size(); ++loop) {
    for (const int unknown : unknowns_of_loop[loop]) {
      loops_of[unknown].push_back(static_cast<int>(loop));
    }
  }
  std::vector<std::vector<char>> has_one;  // per group and loop
  for (int unknown = 0; unknown < mechanism.equations; ++unknown) {
    const auto is_apart = [&](const std::vector<char>& loops) {
      return std::none_of(loops_of[unknown].begin(), loops_of[unknown].end(),
                          [&](int loop) { return loops[loop]; });
    };
    const auto group = std::find_if(has_one.begin(), has_one.end(), is_apart) - has_one.begin();
    if (group == std::ssize(groups)) {
      groups.emplace_back();
      has_one.emplace_back(unknowns_of_loop.size(), false);
    }
    groups[group].push_back(unknown);
    for (const int loop : loops_of[unknown]) has_one[group][loop] = true;
  }
  return groups;
}

std::vector<std::vector<int>> unknowns_of_loops(const Mechanism& mechanism) {
  std::vector<std::vector<int>> unknowns;
  for (const Loop& loop : mechanism.loops) {
    std::vector<int>& mine = unknowns.emplace_back();
    for (const Passage& passage : loop.passages) {
      const int first = mechanism.first_column(passage);
      for (int k = 0; k < (passage.ball ? 3 : 1); ++k) mine.push_back(first + k);
    }
  }
  return unknowns;
}

// Weights of the level: the sum of all |fold angles|.
std::vector<double> level_of(const Mechanism& mechanism) {
  std::vector<double> level(mechanism.unknowns, 0);
  for (const Crease& crease : mechanism.creases) level[crease.column] = crease.assignment;
  return level;
}

// Rows d length / d closure of all diagonals in turn: their gradients through the Jacobian's
// factors, with the level held.
std::vector<double> lengths_per_closure(const Mechanism& mechanism,
                                        const SheetGeometry<double>& geometry,
                                        const TestPlace& at) {
  const int n = mechanism.equations;
  const std::size_t diagonals = mechanism.diagonals.size(),
                    rows_size = diagonals * static_cast<std::size_t>(n);
  std::vector<double> rates(at.tangent), lengths(diagonals), slopes(diagonals), misfit(n);
  std::vector<double> gradients(rows_size);
  folded_lengths_and_slopes(mechanism, geometry, at.base, rates.data(), lengths.data(),
                            slopes.data(), misfit.data());
  for (std::size_t k = 0; k < rows_size; ++k) {
    const std::size_t d = k / static_cast<std::size_t>(n),
                      unknown = k % static_cast<std::size_t>(n);
    gradients[k] = -slopes[d] * at.level[unknown];
  }
  const auto unknowns_of_loop = unknowns_of_loops(mechanism);
  for (const std::vector<int>& group : apart_from_each_other(mechanism, unknowns_of_loop)) {
    rates.assign(mechanism.unknowns, 0);
    for (const int unknown : group) rates[unknown] = 1;
    folded_lengths_and_slopes(mechanism, geometry, at.base, rates.data(), lengths.data(),
                              slopes.data(), misfit.data());
    for (std::size_t d = 0; d < diagonals; ++d) {
      for (const int unknown : unknowns_of_loop[mechanism.diagonals[d].loop]) {
        if (rates[unknown] == 0) continue;
        gradients[d * static_cast<std::size_t>(n) + static_cast<std::size_t>(unknown)] += slopes[d];
      }
    }
  }
  std::vector<double> work(n), rows(rows_size);
  assert(n > 0);
  for (std::size_t first = 0; first < rows.size(); first += static_cast<std::size_t>(n)) {
    at.factors.transposed(gradients.data() + first, work.data(), rows.data() + first);
  }
  return rows;
}

// Largest number of joints of a hole, times the largest distance of two springs' ends across a
// hole.
double bound_of_length_per_rad(const Mechanism& mechanism, const FlatVertices& vertices_mm) {
  double most_joints = 0, widest = 0, beside = 0;
  for (const Loop& loop : mechanism.loops) {
    if (loop.hole < 0) continue;
    double joints = 0;
    for (const Passage& passage : loop.passages) joints += passage.ball ? 3 : 1;
    most_joints = std::max(most_joints, joints);
    for (const Loop::Carrier& carrier : loop.carriers) {
      beside = std::max(beside, carrier.place_mm.norm());
    }
    for (const int a : loop.corners) {
      for (const int b : loop.corners) {
        widest = std::max(widest, (vertices_mm.col(a) - vertices_mm.col(b)).norm());
      }
    }
  }
  return most_joints * (widest + 2 * beside) / mechanism.panel_width_mm;
}

}  // namespace

Model::Model(const PerforatedSheet& base, const std::vector<int>& shifted,
             const PathPlanOptions& path, int threshold_sample, const Criterion& criterion,
             double ternary_mm)
    : base_(base),
      mechanism_(build_mechanism(base)),
      elimination_(is_overconstrained()
                       ? Elimination{}
                       : plan_elimination(mechanism_, base_.folding, base_.sheet.vertices_mm)),
      shape_(base_.sheet, base_.holes, mechanism_),
      shifted_(shifted),
      path_(plan_path(mechanism_, base.folding, base.sheet.vertices_mm, path)),
      sample_deg_(path.sample_deg),
      threshold_sample_(threshold_sample),
      criterion_(criterion),
      ternary_mm_(ternary_mm),
      margin_samples_(threshold_sample > 0 && !is_overconstrained()
                          ? solver::margin_samples(path.sample_deg, threshold_sample)
                          : std::vector<int>()),
      extent_((base.sheet.vertices_mm.colwise() - base.sheet.vertices_mm.col(0).eval())
                  .cwiseAbs()
                  .maxCoeff() /
              mechanism_.panel_width_mm),
      length_per_rad_(bound_of_length_per_rad(mechanism_, base.sheet.vertices_mm)) {
  assert(
      std::ranges::all_of(shifted, [&](int v) { return v >= 0 && v < base.sheet.vertex_count(); }));
  assert(criterion.bumps != BumpRule::exact || base.springs.in_mid_plane());
  assert(threshold_sample >= 0 && path.sample_deg > 0 && std::isfinite(extent_));
  if (!is_overconstrained()) choose_tests();
}

void Model::choose_tests() {
  const double far_deg = std::min(
      kSafeFromBase_deg / 180 * base_.folding.end_deg(),
      last_sample_of_slopes(threshold_sample_, sample_deg_) * sample_deg_ - kPilotsDiffer_deg);
  if (threshold_sample_ == 0 || !(far_deg >= kLeastFar_deg)) return;
  for (const double share : kPlaces) tests_.push_back(test_at(share * far_deg));
}

TestPlace Model::test_at(double pilot_deg) const {
  assert(pilot_deg > 0 && pilot_deg <= 180);
  const HalfAngle<double> pilot = half_angle_of_deg(pilot_deg);
  TestPlace at{pilot_deg,
               base_state(mechanism_, base_.folding, base_.sheet.vertices_mm, pilot),
               SparseLu<double>(elimination_),
               {},
               std::vector<double>(mechanism_.unknowns),
               {},
               0};
  at.level = level_of(mechanism_);
  SheetGeometry<double> geometry;
  place(mechanism_, base_.sheet.vertices_mm, geometry);
  std::vector<double> residual(mechanism_.equations), work(mechanism_.unknowns);
  evaluate(mechanism_, geometry, at.base, residual.data(), at.factors.entries());
  at.factors.factorize();
  at.factors.null_vector(-at.factors.pilot_coefficient(), at.factors.partner_coefficient(),
                         work.data(), at.tangent.data());
  const double change =
      std::inner_product(at.level.begin(), at.level.end(), at.tangent.begin(), 0.0);
  const double per_pilot = change / at.tangent.back();
  at.orientation = (at.factors.orientation() < 0) == (change < 0) ? 1 : -1;
  for (double& weight : at.level) weight /= per_pilot;
  const double of_pilot = at.tangent.back();
  for (double& rate : at.tangent) rate /= of_pilot;
  at.lengths_per_closure = lengths_per_closure(mechanism_, geometry, at);
  return at;
}

void Model::displace(const double* shifts_mm, FlatVertices& vertices_mm) const {
  vertices_mm = base_.sheet.vertices_mm;
  for (const int vertex : shifted_) {
    vertices_mm.col(vertex) += Eigen::Vector2d(shifts_mm[0], shifts_mm[1]);
    shifts_mm += 2;
  }
}

}  // namespace misalign::solver
