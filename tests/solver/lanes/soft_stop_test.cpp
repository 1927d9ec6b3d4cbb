// The stop that a campaign asks for on the way: its stiffness against the energy of springs, by
// lengths alone; and the same verdicts by functions, in close steps and by dense matrices.
#include "solver/lanes/lane_batch.hpp"
#include "solver/reference/reference.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

// Histories go on after a fault: how the path ends does not count.
std::string said(Verdict verdict) {
  verdict.path_end = PathEnd::end_reached;
  return words(verdict);
}

class SoftStop : public testing::Test {
 protected:
  static constexpr int kThreshold = 90;
  static constexpr double kSample_deg = 1;

  Model asking(int stop_deg, double least, BumpRule bumps = BumpRule::ignored) const {
    return Model(sheets_.base, sheets_.shifted_vertices, {kSample_deg}, kThreshold,
                 {bumps, stop_deg, least});
  }
  // The second difference, over 2 h, of k/2 sum (L - L(stop))^2, by lengths in steps of h.
  double stiffness_by_energy(const FlatVertices& vertices_mm, int stop_deg) const {
    constexpr double kStep_deg = 0.1;
    const int at = static_cast<int>(std::lround(stop_deg / kStep_deg)) - 1;
    const auto history =
        record_history(Model(sheets_.base, {kStep_deg, stop_deg + 1.0}), vertices_mm);
    if (history.length_mm.rows() < at + 2) return 0;
    const double h = kStep_deg * kRadPerDeg * sheets_.base.sheet.panel_width_mm;
    double energies = 0;
    for (const int k : {at - 1, at + 1}) {
      energies += (history.length_mm.row(k) - history.length_mm.row(at)).squaredNorm() / 2;
    }
    return energies / (h * h);
  }

  const DrawableSheet sheets_{4, 4};
  const ShiftBlock block_ = sheets_.draws(20 / kFewer + 2, kSeed + 16);
};

// Where the sheet gets to the stop it is held there as the second difference of the energy says;
// that is off by 1e-6 of itself, for a fourth derivative like the second one.
TEST_F(SoftStop, IsSofterThanTheEnergySays) {
  int stops = 0;
  for (int i = 0; i < block_.sheets; ++i) {
    const FlatVertices vertices_mm = sheets_.vertices(block_, i);
    const Verdict without = record_history(Model(sheets_.base), vertices_mm).verdict;
    for (const int stop_deg : {1, 30, 60, 90}) {
      if (without.deploys_from_sample < stop_deg) continue;
      SCOPED_TRACE(std::to_string(i) + " at " + std::to_string(stop_deg));
      ++stops;
      const double stiffness = stiffness_by_energy(vertices_mm, stop_deg);
      const double room = stop_deg == 1 ? 0.02 : 1e-3;  // near flat it grows with the square
      const ShiftBlock one = chosen_of(block_, {i});
      for (const double share : {0.9, 1 - room, 1 + room, 1.1}) {  // 0.9, 1.1: by functions
        const Model model = asking(stop_deg, share * stiffness);
        LaneBatch<double, float> batch(model);
        const Verdict verdict = batch.judge(one)[0];
        const bool is_soft = share > 1;
        EXPECT_EQ(verdict.first_fault == Fault::soft_stop, is_soft)
            << fault_name(verdict.first_fault);
        EXPECT_EQ(verdict.deploys_from_sample,
                  is_soft ? stop_deg - 1 : without.deploys_from_sample);
        EXPECT_EQ(said(verdict), said(record_history(model, vertices_mm).verdict));
      }
    }
  }
  EXPECT_GE(stops, 4);
}

// Of stops that are as stiff as was asked for up to rounding too: polynomials leave those to close
// steps, whose slopes are those of dense matrices to 1e-9 of the stiffness.
TEST_F(SoftStop, IsTheSameByEveryMeansSlow) {
  constexpr int kStop_deg = 45;
  int soft = 0, stiff = 0;
  for (int i = 0; i < block_.sheets; ++i) {
    const FlatVertices vertices_mm = sheets_.vertices(block_, i);
    const auto history = record_history(Model(sheets_.base), vertices_mm);
    if (history.verdict.deploys_from_sample < kStop_deg) continue;
    std::vector<double> slopes;
    for (Eigen::Index d = 0; d < history.slope_mm_per_deg.cols(); ++d) {
      slopes.push_back(history.slope_mm_per_deg(kStop_deg - 1, d) /
                       (kRadPerDeg * sheets_.base.sheet.panel_width_mm));
    }
    const double stiffness = stop_stiffness(slopes);
    const ShiftBlock one = chosen_of(block_, {i});
    for (const BumpRule bumps : {BumpRule::ignored, BumpRule::exact}) {
      for (const double more : {-0.06, -0.04, -1e-8, 1e-8, 0.04, 0.06}) {
        SCOPED_TRACE(std::to_string(i) + " more " + std::to_string(more));
        const Model model = asking(kStop_deg, (1 + more) * stiffness, bumps);
        const PathPlan plan =
            plan_path(model.mechanism(), sheets_.base.folding, sheets_.base.sheet.vertices_mm,
                      reference_path({kSample_deg}, 5, bumps));
        Reference reference(model.mechanism(), plan, model.criterion());
        const Verdict expected = reference.judge(vertices_mm);
        ++(expected.first_fault == Fault::soft_stop ? soft : stiff);
        EXPECT_EQ(expected.first_fault == Fault::soft_stop, more > 0);
        EXPECT_EQ(said(record_with_pivoting(model, vertices_mm).verdict), said(expected));
        for (const InstructionSet set : available_instruction_sets()) {
          const auto batch = make_batch(set, model);
          EXPECT_EQ(said(batch->judge(one)[0]), said(expected)) << instruction_set_name(set);
        }
      }
    }
  }
  EXPECT_GT(soft, 0);
  EXPECT_GT(stiff, 0);
}

// Records, by which candidates are measured, say the same, and up to D the same as without a stop.
TEST_F(SoftStop, IsTheSameInRecordsSlow) {
  constexpr int kStop_deg = 60;
  const Model without = asking(0, 0), some = asking(kStop_deg, 2e-4);
  const auto plain = make_batch(available_instruction_sets().back(), without);
  const auto stopping = make_batch(available_instruction_sets().back(), some);
  const std::vector<Verdict> verdicts = stopping->judge(block_);
  const std::vector<PathRecord> records = stopping->measure(block_);
  const std::vector<PathRecord> plain_records = plain->measure(block_);
  int kept = 0;
  for (int i = 0; i < block_.sheets; ++i) {
    EXPECT_EQ(records[i].verdict.deploys_from_sample, verdicts[i].deploys_from_sample) << i;
    EXPECT_EQ(records[i].verdict.first_fault, verdicts[i].first_fault) << i;
    if (verdicts[i].deploys_from_sample < kThreshold) continue;
    ++kept;
    EXPECT_EQ(records[i].lengths, plain_records[i].lengths) << i;
  }
  EXPECT_GT(kept, 0);
}

}  // namespace
}  // namespace misalign::solver
