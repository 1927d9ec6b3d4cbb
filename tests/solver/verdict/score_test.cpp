// Scores: parabolas whose turning points are known; and of drawn sheets what their lengths, solved
// sample by sample past the fault, say by themselves, on every instruction set.
#include "solver/lanes/lane_batch.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

// Of a made-up path whose first diagonal is a parabola with its top at `top` samples.
int score_of_parabola(double top, double curvature_widths, BumpRule bumps = BumpRule::ignored) {
  const TestSheet sheet(4, 4);
  Criterion criterion{bumps};
  criterion.scores = true;
  Judge judge(sheet.mechanism, criterion);
  const FoldState<double> state = sheet.folded(30);
  const std::size_t diagonals = sheet.mechanism.diagonals.size();
  const auto lengths_at = [&](int sample) {
    std::vector<double> lengths(diagonals, 1 + 1e-3 * sample);
    lengths[0] = 1 - curvature_widths * (sample - top) * (sample - top);
    return lengths;
  };
  std::vector<double> slopes(diagonals, 1e-3 / kRadPerDeg);
  judge.begin(lengths_at(0));
  int sample = 1;
  do {
    slopes[0] = 2 * curvature_widths * (top - sample) / kRadPerDeg;
  } while (judge.see({1.0 * sample, half_angle_of_deg(sample), sample, true}, &state,
                     lengths_at(sample), &slopes) &&
           ++sample);
  return judge.conclude({PathEnd::stopped, 0, 0, 0, 0}).score;
}

// A top half a sample beyond D scores a whole sample: 1024 times the top plus a half.
TEST(Score, IsWhereAParabolaTurns) {
  for (const double curvature : {1e-9, 1e-4}) {
    for (const double top : {0.8, 1.3, 2.26, 6.5 + 0.1 / 1024, 6.6, 7.1, 7.49}) {
      EXPECT_EQ(score_of_parabola(top, curvature),
                static_cast<int>(std::floor((top + 0.5) * kScoresPerSample)))
          << top << " " << curvature;
    }
  }
}

// Who looks between the samples sees the top itself.
TEST(Score, IsTheTopWhereCubicsAreLookedAt) {
  for (const double top : {1.3, 2.26, 6.5, 6.6, 7.1, 7.49, 7.51, 7.999}) {
    EXPECT_EQ(score_of_parabola(top, 1e-4, BumpRule::by_cubic),
              static_cast<int>(std::floor(top * kScoresPerSample)))
        << top;
  }
}

TEST(Score, LiesBetweenWholeSamples) {
  EXPECT_EQ(scores_of(-1e-9), 0);
  EXPECT_EQ(scores_of(1), kScoresPerSample - 1);  // by rounding: the fault is one nevertheless
  EXPECT_EQ(turning_part(-1, 1), 0);              // it went back within the band before
  EXPECT_EQ(excess_part(0, 0.01), 1);
  EXPECT_NEAR(excess_part(std::sin(0.005), 0.01), 0.5, 1e-15);
}

TEST(Score, IsCertainIfNoOtherIsPossible) {
  LeastPart part;
  part.add(0.5005, 1e-5);
  EXPECT_TRUE(part.is_certain());
  part.add(0.7, 0.01);  // not the least
  EXPECT_TRUE(part.is_certain());
  part.add(0.51, 0.02);  // perhaps the least
  EXPECT_FALSE(part.is_certain());
}

// The part before the first fault from lengths alone, or from the limit; nothing for creases.
std::optional<double> part_of(const FoldingHistory& history) {
  const int D = history.verdict.deploys_from_sample;
  if (history.verdict.first_fault == Fault::fold_limit) return history.path.fold_limit_deg - D;
  if (history.verdict.first_fault == Fault::none) return 0;
  if (history.verdict.first_fault != Fault::not_monotone) return std::nullopt;
  const auto length = [&](int sample, Eigen::Index d) {
    return sample == 0 ? history.flat_mm[static_cast<std::size_t>(d)]
                       : history.length_mm(sample - 1, d);
  };
  double least = 1;
  for (Eigen::Index d = 0; d < history.length_mm.cols(); ++d) {
    const double way = length(1, d) - length(0, d), back = length(D, d) - length(D + 1, d);
    if (way * back <= 0) continue;
    least = std::min(least, 1 - back / (2 * length(D, d) - length(D - 1, d) - length(D + 1, d)));
  }
  return least;
}

// By functions, in close steps and past 178.5 degrees; lengths to 1e-13 widths of steps of 1e-6 and
// more leave 1e-6 of a part.
TEST(Score, IsThatOfTheSolvedLengths) {
  const DrawableSheet sheets{4, 4};
  const ShiftBlock block = sheets.draws(800 / kFewer, kSeed + 17);
  Criterion criterion;
  criterion.scores = true;
  const Model model(sheets.base, sheets.shifted_vertices, {1}, 150, criterion);
  const Model plain(sheets.base, sheets.shifted_vertices, {1}, 150);
  const std::vector<Verdict> verdicts =
      make_batch(available_instruction_sets().back(), model)->judge(block);
  const std::vector<Verdict> plain_verdicts =
      make_batch(available_instruction_sets().back(), plain)->judge(block);
  int reversals = 0, limits = 0, deep = 0;
  for (int i = 0; i < block.sheets; ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(verdicts[i].deploys_from_sample, plain_verdicts[i].deploys_from_sample);
    EXPECT_EQ(plain_verdicts[i].score, kNoScore);
    if (verdicts[i].first_fault == Fault::inactive_diagonal) continue;
    EXPECT_EQ(verdicts[i].score / kScoresPerSample, verdicts[i].deploys_from_sample);
    const bool is_deep = verdicts[i].deploys_from_sample > 120;
    if (!is_deep && i % 50 > 0) continue;
    const FoldingHistory history = record_history(plain, sheets.vertices(block, i));
    const std::optional<double> part = part_of(history);
    if (!part || history.verdict.deploys_from_sample == 0) continue;
    const int score = verdicts[i].score % kScoresPerSample;
    EXPECT_GE(score, scores_of(*part - 1e-6));
    EXPECT_LE(score, scores_of(*part + 1e-6));
    ++(history.verdict.first_fault == Fault::fold_limit ? limits : reversals);
    deep += is_deep;
  }
  EXPECT_GT(reversals, 0);
  EXPECT_GT(deep, 0);
  RecordProperty("limits", limits);
}

// Of this diagonal between D and the next sample, by solved slopes a fiftieth of a degree apart.
std::optional<double> turn_between(const DrawableSheet& sheets, const FlatVertices& vertices_mm,
                                   const Verdict& verdict) {
  const int D = verdict.deploys_from_sample;
  PathPlanOptions path{1};
  path.end_deg = D + 1;
  path.look_deg = 0.02;
  const FoldingHistory history = record_history(Model(sheets.base, path), vertices_mm);
  double last = 0, last_deg = 0;
  for (std::size_t row = 0; row < history.stations.size(); ++row) {
    const double deg = history.stations[row].pilot_deg;
    const double slope = history.slope_mm_per_deg(static_cast<Eigen::Index>(row), verdict.where);
    if (last_deg >= D && last * slope < 0) {
      return last_deg + (deg - last_deg) * last / (last - slope) - D;
    }
    last = slope;
    last_deg = deg;
  }
  return std::nullopt;
}

// Where going back between samples is a fault, by functions and in close steps: within one score.
TEST(Score, IsWhereADiagonalTurnsBetweenSamples) {
  const DrawableSheet sheets{4, 4};
  const ShiftBlock block = sheets.draws(4000 / kFewer, kSeed + 19);
  const Model model(sheets.base, sheets.shifted_vertices, {1}, 170, {BumpRule::exact, 0, 0, true});
  const std::vector<Verdict> verdicts =
      make_batch(available_instruction_sets().back(), model)->judge(block);
  int functions = 0, close_steps = 0;
  for (int i = 0; i < block.sheets; ++i) {
    const Verdict& verdict = verdicts[i];
    if (verdict.first_fault != Fault::reverses_between || verdict.deploys_from_sample < 20)
      continue;
    const bool is_deep = verdict.deploys_from_sample > 177;
    if (!is_deep && functions == 20 / kFewer) continue;
    const std::optional<double> part = turn_between(sheets, sheets.vertices(block, i), verdict);
    if (!part) continue;  // it had turned before D by less than the band
    EXPECT_NEAR(verdict.score % kScoresPerSample, *part * kScoresPerSample, 1 + 0.01) << i;
    EXPECT_EQ(verdict.score / kScoresPerSample, verdict.deploys_from_sample);
    ++(is_deep ? close_steps : functions);
  }
  EXPECT_GT(functions, 0);
  EXPECT_GE(close_steps, kFewer == 1 ? 1 : 0);
}

// Also where a polynomial's errors leave the score in doubt.
TEST(Score, IsTheSameOnEveryInstructionSetSlow) {
  const DrawableSheet sheets{4, 4};
  const ShiftBlock block = sheets.draws(400 / kFewer, kSeed + 18);
  for (const BumpRule bumps : {BumpRule::ignored, BumpRule::by_cubic, BumpRule::exact}) {
    const Model model(sheets.base, sheets.shifted_vertices, {1}, 150, {bumps, 0, 0, true});
    std::vector<Verdict> first;
    for (const InstructionSet set : available_instruction_sets()) {
      const auto batch = make_batch(set, model);
      const std::vector<Verdict>& verdicts = batch->judge(block);
      if (first.empty()) first = verdicts;
      for (int i = 0; i < block.sheets; ++i) {
        ASSERT_EQ(verdicts[i].score, first[i].score) << instruction_set_name(set) << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace misalign::solver
