#include "solver/model/model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/linear/pivot_order.hpp"
#include "solver/model/miscut_margin.hpp"
#include "solver/model/rejection_test.hpp"

namespace misalign::solver {
namespace {

// Of 180 degrees, in proportion where the base folding ends earlier: beyond it the state next to
// the base folding may lie on another branch than the path's own (35 of 1,722 at 170 degrees, none
// of 2,500 at 150).
constexpr double kSafeFromBase_deg = 150;

// Where the first test at the far angle lets a sheet pass, this share of it shows in which
// direction its diagonals set out: with both, nine of ten sheets are decided.
constexpr double kNearShare = 0.2;

// From the far test to the threshold in steps of about this, if it is farther than the other;
// before it, where less happens, in steps of three times that.
constexpr double kApproachStep_deg = 5, kApproachFrom_deg = 2;

// Of 100 sheets that are left at 150 degrees, 40 reverse by 155 and 30 more by 160; most of the
// others have a fold limit, which is found along the path.
constexpr int kMostBeyond = 2;

// Unknowns but the pilot, in groups of which no loop has two: a diagonal answers to the joints of
// its own loop alone, so that one evaluation serves a group.
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

// Rows d length / d closure of all diagonals, one after another: their gradients, through the
// Jacobian's factors.
std::vector<double> lengths_per_closure(const Mechanism& mechanism,
                                        const SheetGeometry<double>& geometry,
                                        const FoldState<double>& state,
                                        const SparseLu<double>& factors) {
  const int n = mechanism.equations;
  const std::size_t diagonals = mechanism.diagonals.size();
  std::vector<double> rates(mechanism.unknowns), lengths(diagonals), slopes(diagonals), misfit(n);
  std::vector<double> gradients(diagonals * static_cast<std::size_t>(n));
  const auto unknowns_of_loop = unknowns_of_loops(mechanism);
  for (const std::vector<int>& group : apart_from_each_other(mechanism, unknowns_of_loop)) {
    rates.assign(mechanism.unknowns, 0);
    for (const int unknown : group) rates[unknown] = 1;
    folded_lengths_and_slopes(mechanism, geometry, state, rates.data(), lengths.data(),
                              slopes.data(), misfit.data());
    for (std::size_t d = 0; d < diagonals; ++d) {
      for (const int unknown : unknowns_of_loop[mechanism.diagonals[d].loop]) {
        if (rates[unknown] == 0) continue;
        gradients[d * static_cast<std::size_t>(n) + static_cast<std::size_t>(unknown)] = slopes[d];
      }
    }
  }
  std::vector<double> work(n), rows(gradients.size());
  assert(n > 0 && rows.size() == diagonals * static_cast<std::size_t>(n));
  for (std::size_t first = 0; first < rows.size(); first += static_cast<std::size_t>(n)) {
    factors.transposed(gradients.data() + first, work.data(), rows.data() + first);
  }
  return rows;
}

// Joints of the hole with the most of them, times the largest distance across a hole from end to
// end of a spring.
double bound_of_length_per_rad(const Mechanism& mechanism, const FlatVertices& vertices_mm) {
  double most_joints = 0, widest = 0, beside = 0;
  for (const Loop& loop : mechanism.loops) {
    if (loop.hole < 0) continue;
    double joints = 0;
    for (const Passage& passage : loop.passages) joints += passage.ball ? 3 : 1;
    most_joints = std::max(most_joints, joints);
    for (const SpringCarrier& carrier : loop.carriers) {
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
      elimination_(has_spare_equations()
                       ? Elimination{}
                       : plan_elimination(mechanism_, base_.folding, base_.sheet.vertices_mm)),
      shape_(base_.sheet, base_.holes, mechanism_),
      shifted_(shifted),
      path_(plan_path(mechanism_, base.folding, base.sheet.vertices_mm, path)),
      sample_deg_(path.sample_deg),
      threshold_sample_(threshold_sample),
      criterion_(criterion),
      ternary_mm_(ternary_mm),
      margin_samples_(threshold_sample > 0 && !has_spare_equations()
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
  if (!has_spare_equations()) choose_tests();
}

void Model::choose_tests() {
  const auto sample_at = [&](double angle_deg) {
    return static_cast<int>(std::floor(angle_deg / sample_deg_ * (1 + 1e-9)));
  };
  const int far = std::min(sample_at(kSafeFromBase_deg / 180 * base_.folding.end_deg()),
                           last_sample_of_slopes(threshold_sample_, sample_deg_));
  const int near = static_cast<int>(std::lround(kNearShare * far));
  for (const int sample : {far, near}) {
    if (sample < 1 || sample >= far + (sample == far)) continue;
    tests_.push_back(angle(sample * sample_deg_, sample, sample == far));
  }
  if (tests_.size() < 2) return;
  const auto add_stations = [&](int from, int to, double step_deg) {
    const int step = std::max(1, sample_at(step_deg));
    for (int k = from; k < to; k += step) {
      approach_.stations.push_back({k * sample_deg_, half_angle_of_deg(k * sample_deg_), k, true});
    }
  };
  add_stations(near, far, kApproachStep_deg * 3);
  if ((threshold_sample_ - far) * sample_deg_ <= kApproachFrom_deg) {
    departs_from_ = 1;
    add_stations(far, far + 1, kApproachStep_deg);
    return;
  }
  add_stations(far, threshold_sample_, kApproachStep_deg);
  for (const Station& station : approach_.stations) {
    if (station.sample <= far || static_cast<int>(beyond_.size()) == kMostBeyond) continue;
    beyond_.push_back(angle(station.pilot_deg, station.sample, true));
  }
  add_stations(threshold_sample_, threshold_sample_ + 1, kApproachStep_deg);
}

TestAngle Model::angle(double pilot_deg, int sample, bool with_slopes) const {
  assert(pilot_deg >= 0 && pilot_deg <= 180);
  const HalfAngle<double> pilot = half_angle_of_deg(pilot_deg);
  TestAngle angle{sample,
                  pilot,
                  base_state(mechanism_, base_.folding, base_.sheet.vertices_mm, pilot),
                  SparseLu<double>(elimination_),
                  {},
                  0,
                  with_slopes};
  SheetGeometry<double> geometry;
  place(mechanism_, base_.sheet.vertices_mm, geometry);
  std::vector<double> residual(mechanism_.equations);
  evaluate(mechanism_, geometry, angle.base, residual.data(), angle.factors.entries());
  angle.factors.factorize();
  angle.determinant_sign = angle.factors.determinant_sign() < 0 ? -1 : 1;
  angle.lengths_per_closure = lengths_per_closure(mechanism_, geometry, angle.base, angle.factors);
  return angle;
}

void Model::displace(const double* shifts_mm, FlatVertices& vertices_mm) const {
  vertices_mm = base_.sheet.vertices_mm;
  for (const int vertex : shifted_) {
    vertices_mm.col(vertex) += Eigen::Vector2d(shifts_mm[0], shifts_mm[1]);
    shifts_mm += 2;
  }
}

}  // namespace misalign::solver
