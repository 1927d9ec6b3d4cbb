#include "tests/bench/scale/invented_draws.hpp"

#include <algorithm>
#include <stdexcept>

#include "schema/records/fault_sample.hpp"

namespace misalign::bench {
namespace {

solver::Mechanism mechanism_of(const schema::Campaign& campaign) {
  const auto& base = campaign.pattern.base;
  return solver::build_mechanism(base);
}

}  // namespace

InventedDraws::InventedDraws(unsigned seed) : mechanism_(mechanism_of(campaign_)), random_(seed) {}

// Means and spreads are those of 4,466 real candidates.
schema::Candidate InventedDraws::candidate(std::uint64_t draw) {
  schema::Candidate c{
      draw, {}, Eigen::Matrix2Xd::Zero(2, campaign_.pattern.base.sheet.vertex_count())};
  solver::Metrics& m = c.metrics;
  m.deploys_from_sample =
      std::min(170 + static_cast<int>(std::geometric_distribution(0.34)(random_)), 180);
  m.deploys_from_deg = m.deploys_from_sample;
  m.fold_limit_deg = 180;
  for (std::size_t k = 0; k < mechanism_.diagonals.size(); ++k) {
    m.elongation.push_back((k % 2 ? -1 : 1) * (1e-4 + exponential(0.025)));
  }
  const auto [low, high] = std::minmax_element(m.elongation.begin(), m.elongation.end());
  m.elongation_min = *low;
  m.elongation_max = *high;
  m.stroke_min = exponential(0.0056);
  m.stroke_max = *high;
  m.slope_min_mm_per_deg = exponential(1.9e-4);
  m.slope_between_min_mm_per_deg = *m.slope_min_mm_per_deg * 0.9;
  m.miscut_margin_mm = exponential(0.03);
  if (std::bernoulli_distribution(0.005)(random_)) {
    m.slope_between_min_mm_per_deg = -exponential(1e-5);
    m.bump_deg = 5 + exponential(20);
  }
  m.stretch_sq_mm2 = 20 + exponential(120);
  m.singular_value_min = exponential(2.6e-4);
  m.residual_max = exponential(1e-14);
  m.isometry_error_mm = exponential(1.2e-12);
  m.kawasaki_defect_deg = exponential(0.5);
  std::uniform_int_distribution level(-1, 1);
  for (const int vertex : campaign_.misalignment.vertices) {
    for (int axis = 0; axis < 2; ++axis) {
      c.shifts_mm(axis, vertex) = level(random_) * campaign_.misalignment.amplitude_mm;
    }
    m.shifted_vertices += !c.shifts_mm.col(vertex).isZero();
  }
  m.increasing = m.decreasing = static_cast<int>(m.elongation.size()) / 2;
  return c;
}

schema::DrawVerdict InventedDraws::sampled(std::uint64_t draw) {
  std::uniform_int_distribution sample(0, 175), place(0, mechanism_.diagonal_count() - 1);
  if (std::bernoulli_distribution(0.005)(random_)) {
    return {draw, {sample(random_), solver::Fault::fold_limit, -1}};
  }
  return {draw, {sample(random_), solver::Fault::not_monotone, place(random_)}};
}

schema::UnitRecord InventedDraws::unit(const schema::DrawRange& range,
                                       const UnitContents& contents) {
  schema::UnitRecord unit;
  unit.range = range;
  unit.seconds = 5 + exponential(0.1);
  if (contents.candidates > range.size()) throw std::logic_error("more candidates than draws");
  for (std::uint64_t k = 0; k < contents.candidates; ++k) {
    unit.candidates.push_back(candidate(range.lo + k * (range.size() / contents.candidates)));
  }
  unit.accepted = contents.candidates;
  unit.rejected = range.size() - contents.candidates;
  const schema::FaultSampleRule rule;
  if (contents.sampled > rule.rows_in(range)) {
    throw std::logic_error("more sampled draws than there are");
  }
  constexpr std::uint64_t kEvery = schema::kFaultSampleEvery;
  for (std::uint64_t draw = (range.lo + kEvery - 1) / kEvery * kEvery;
       unit.fault_sample.size() < contents.sampled; draw += kEvery) {
    if (rule.holds(draw)) unit.fault_sample.push_back(sampled(draw));
  }
  for (int k = 0; k < contents.screened; ++k) {
    const auto fault = k % 10 ? solver::Fault::not_monotone : solver::Fault::fold_limit;
    unit.screened[{static_cast<int>(fault), k}] = unit.rejected / contents.screened + 1;
  }
  return unit;
}

schema::RunInfo invented_run(int ranks) {
  return {"host", "0", "none", "g++", "-O3", "golden", ranks};
}

}  // namespace misalign::bench
