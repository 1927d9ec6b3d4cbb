#include "search/draws/draw_evaluator.hpp"

#include <gtest/gtest.h>

#include <set>

#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw.hpp"
#include "search/ranks/messages.hpp"
#include "search/sheets/folding_model.hpp"
#include "solver/records/record_sheet.hpp"
#include "solver/reference/reference.hpp"
#include "tests/solver/record_path.hpp"

namespace misalign::search {
namespace {

schema::Campaign miura_4x4(double threshold_deg = 150) {
  return schema::read_campaign({{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                                {"accept", {{"deploys_from_deg", threshold_deg}}}},
                               "a test");
}

using schema::Json;

std::string words_of(const solver::Verdict& verdict) {
  return std::to_string(verdict.deploys_from_sample) + " " +
         solver::fault_name(verdict.first_fault) + " " + std::to_string(verdict.where);
}

// The frozen reference's verdict on one draw: dense matrices, every degree.
solver::Verdict reference_verdict(const schema::Campaign& campaign, const DrawEvaluator& evaluator,
                                  std::uint64_t draw) {
  const solver::PerforatedSheet& base = campaign.pattern.base;
  const auto plan = solver::plan_path(evaluator.mechanism(), base.folding, base.sheet.vertices_mm,
                                      campaign.path());
  solver::Reference reference(evaluator.mechanism(), plan);
  return reference.judge(base.sheet.vertices_mm + evaluator.shifts_mm(draw));
}

solver::FoldingHistory history_of(const DrawEvaluator& evaluator, std::uint64_t draw) {
  return solver::record_history(
      evaluator.model(), evaluator.model().base().sheet.vertices_mm + evaluator.shifts_mm(draw));
}

// The accepted patterns are the reference's, their metrics belong to the verdict, and do not depend
// on what else is in the block.
TEST(DrawEvaluator, CandidatesAreWhatTheirDrawsGive) {
  DrawEvaluator evaluator(miura_4x4());
  const schema::UnitRecord unit = work_off(evaluator, {0, 60});
  EXPECT_EQ(unit.accepted + unit.rejected, 60u);
  EXPECT_GT(unit.accepted, 10u);
  std::size_t next = 0;
  for (std::uint64_t draw = 0; draw < 60; ++draw) {
    const solver::Verdict verdict = reference_verdict(evaluator.campaign(), evaluator, draw);
    const bool accepted = next < unit.candidates.size() && unit.candidates[next].draw == draw;
    EXPECT_EQ(accepted, verdict.deploys_from_sample >= 150) << "draw " << draw;
    if (!accepted) continue;
    const schema::Candidate& candidate = unit.candidates[next++];
    const solver::Metrics& m = candidate.metrics;
    EXPECT_EQ(m.deploys_from_sample, verdict.deploys_from_sample);
    EXPECT_EQ(m.increasing + m.decreasing, 4);
    EXPECT_GE(m.fold_limit_deg, m.deploys_from_deg);
    EXPECT_LE(m.stroke_min, m.stroke_max);
    EXPECT_EQ(m.stroke_max, std::max(m.elongation_max, -m.elongation_min));
    EXPECT_GT(*m.slope_min_mm_per_deg, 0);
    EXPECT_LE(m.isometry_error_mm, 1e-9);
    EXPECT_LE(m.residual_max, 1e-12);

    DrawEvaluator fresh(miura_4x4());
    const schema::UnitRecord again = work_off(fresh, {draw, draw + 1});
    ASSERT_EQ(again.candidates.size(), 1u);
    EXPECT_EQ(again.candidates[0].metrics.stretch_sq_mm2, m.stretch_sq_mm2);
    EXPECT_EQ(again.candidates[0].metrics.singular_value_min, m.singular_value_min);
    EXPECT_EQ(again.candidates[0].shifts_mm, candidate.shifts_mm);
  }
}

// Where draws are asked of tables first; sheets of which nothing is known have none.
TEST(DrawEvaluator, UnitsSayAtWhichLevelTablesAre) {
  DrawEvaluator ternary(miura_4x4());
  const double level_deg = work_off(ternary, {0, 60}).tables_deg;
  EXPECT_TRUE(level_deg == 115 || level_deg == 130 || level_deg == 140) << level_deg;
  schema::Campaign campaign = miura_4x4();
  campaign.misalignment.distribution = schema::ShiftDistribution::uniform;
  DrawEvaluator uniform(campaign);
  EXPECT_EQ(work_off(uniform, {0, 60}).tables_deg, 0);
}

// `search/campaigns/miura-4x4.json` with a threshold next to their fold limits, 161.079 and 161.033
// degrees: A18-A12 goes back between 159.88 degrees and a little beyond 160.
TEST(DrawEvaluator, TurnsAboutTheLastSampleAreNoReason) {
  const schema::Campaign campaign = miura_4x4(161);
  DrawEvaluator evaluator(campaign);
  for (const std::uint64_t draw : {62899, 92700}) {
    const solver::Verdict verdict = reference_verdict(campaign, evaluator, draw);
    EXPECT_EQ(verdict.deploys_from_sample, 161) << "draw " << draw;
    EXPECT_EQ(work_off(evaluator, {draw, draw + 1}).accepted, 1u) << "draw " << draw;
  }
}

// Metrics again from the history, by loops of their own.
TEST(DrawEvaluator, MetricsFromTheHistory) {
  DrawEvaluator evaluator(miura_4x4());
  const schema::UnitRecord unit = work_off(evaluator, {0, 20});
  ASSERT_FALSE(unit.candidates.empty());
  const solver::Metrics& m = unit.candidates[0].metrics;
  const auto history = history_of(evaluator, unit.candidates[0].draw);
  const Eigen::Index d_samples = m.deploys_from_sample;
  const Eigen::Map<const Eigen::RowVectorXd> flat(history.flat_mm.data(), 4);
  const Eigen::MatrixXd lengths = history.length_mm.topRows(d_samples);
  const Eigen::MatrixXd stretch = lengths.rowwise() - flat;
  const Eigen::MatrixXd elongation = stretch.array().rowwise() / flat.array();
  // Both solve these states, each its own way to them: loops close to 1e-12 of a panel.
  EXPECT_NEAR(m.elongation_max, std::max(0.0, elongation.maxCoeff()), 1e-12);
  EXPECT_NEAR(m.elongation_min, std::min(0.0, elongation.minCoeff()), 1e-12);
  EXPECT_NEAR(m.stretch_sq_mm2, stretch.bottomRows(1).squaredNorm(), 1e-9 * m.stretch_sq_mm2);
  const Eigen::MatrixXd slopes =
      (lengths.bottomRows(d_samples - 4) - lengths.middleRows(3, d_samples - 4)).cwiseAbs();
  EXPECT_NEAR(*m.slope_min_mm_per_deg, slopes.minCoeff(), 1e-12 * 80);
  EXPECT_NEAR(m.stroke_min, elongation.cwiseAbs().colwise().maxCoeff().minCoeff(), 1e-12);
  EXPECT_EQ(m.increasing, (stretch.bottomRows(1).array() > 0).count());
}

TEST(DrawEvaluator, UnitsCountEveryDrawOnce) {
  DrawEvaluator evaluator(miura_4x4());
  UnitWork work(evaluator, {1000, 1040});
  work.run_next_block();
  work.run_next_block();
  EXPECT_FALSE(work.finished());
  const schema::UnitRecord unit = work.take();
  EXPECT_EQ(unit.range.lo, 1000u);
  EXPECT_GT(unit.range.hi, 1001u);
  EXPECT_LT(unit.range.hi, 1040u);
  EXPECT_EQ(unit.accepted + unit.rejected + unit.undecided.size(), unit.range.size());
  EXPECT_EQ(unit.accepted, unit.candidates.size());
  std::uint64_t screened = 0;
  for (const auto& [seen, draws] : unit.screened) screened += draws;
  EXPECT_EQ(screened, unit.rejected);
}

// A unit whose results take more than one message may is several: none of them larger than that and
// a block, and together what one unit would have been.
TEST(DrawEvaluator, UnitsThatAreFullGoOnInOthersSlow) {
  constexpr schema::DrawRange kAll{0, 600};
  DrawEvaluator evaluator(miura_4x4());
  const schema::UnitRecord whole = work_off(evaluator, kAll);
  ASSERT_GT(whole.candidates.size(), 100u);
  const std::size_t most_bytes = 20 * evaluator.bytes_of_candidate();
  std::vector<std::uint64_t> accepted;
  std::uint64_t rejected = 0, next = kAll.lo;
  int units = 0;
  for (; next < kAll.hi; ++units) {
    UnitWork work(evaluator, {next, kAll.hi}, schema::FaultSampleRule(), most_bytes);
    std::uint64_t largest_block = 0, before = next;
    while (!work.finished() && !work.is_full()) {
      work.run_next_block();
      largest_block = std::max(largest_block, work.so_far().range.hi - before);
      before = work.so_far().range.hi;
    }
    const schema::UnitRecord unit = work.take();
    EXPECT_EQ(unit.range.lo, next);
    next = unit.range.hi;
    rejected += unit.rejected;
    for (const schema::Candidate& candidate : unit.candidates) accepted.push_back(candidate.draw);
    EXPECT_LE(pack({unit}).size(), most_bytes + largest_block * evaluator.bytes_of_candidate());
    // What is counted is no less than what is sent.
    EXPECT_LE(pack({unit}).size(), 1000 + unit.screened.size() * 16 +
                                       unit.candidates.size() * evaluator.bytes_of_candidate() +
                                       unit.undecided.size() * sizeof(schema::DrawVerdict) +
                                       unit.fault_sample.size() * sizeof(schema::DrawVerdict));
  }
  EXPECT_GT(units, 3);
  EXPECT_EQ(rejected, whole.rejected);
  EXPECT_EQ(accepted, whole.accepted_draws());
}

// Draws of the fault sample take the full path whatever the fast tests saw: the sample has their
// first fault, at a threshold that almost all of them miss.
TEST(DrawEvaluator, FaultSampleHasTheFirstFault) {
  DrawEvaluator evaluator(miura_4x4(180));
  const schema::UnitRecord unit = work_off(evaluator, {1000, 3100});
  ASSERT_EQ(unit.fault_sample.size(), 3u);
  for (const schema::DrawVerdict& sampled : unit.fault_sample) {
    EXPECT_EQ(sampled.draw % 1024, 0u);
    const solver::Verdict expected =
        reference_verdict(evaluator.campaign(), evaluator, sampled.draw);
    EXPECT_EQ(sampled.verdict.deploys_from_sample, expected.deploys_from_sample);
    EXPECT_EQ(sampled.verdict.first_fault, expected.first_fault);
    EXPECT_EQ(sampled.verdict.where, expected.where);
  }
}

// A draw that the samples pass and that goes back and on again between two of them: found by a
// campaign of 61,440 draws; here against the lengths every two hundredths of a degree.
TEST(DrawEvaluator, BumpBetweenTwoSamplesIsSeen) {
  const Json campaign = {{"pattern", {{"family", "miura"}, {"rows", 6}, {"columns", 6}}},
                         {"misalignment", {{"vertices", "ring"}}},
                         {"accept", {{"deploys_from_deg", 150}}}};
  DrawEvaluator evaluator(schema::read_campaign(campaign, "a test"));
  constexpr std::uint64_t kDraw = 49432;
  const solver::FoldingHistory history = history_of(evaluator, kDraw);
  EXPECT_TRUE(evaluator.campaign().accepts(history.verdict));
  ASSERT_GE(history.between.bump_where, 0);
  const solver::PerforatedSheet& base = evaluator.campaign().pattern.base;
  const solver::FlatVertices vertices_mm = base.sheet.vertices_mm + evaluator.shifts_mm(kDraw);
  const solver::Model model(base);
  const solver::Metrics metrics =
      solver::measure(model, vertices_mm, solver::record_path(model, vertices_mm));
  EXPECT_LT(*metrics.slope_between_min_mm_per_deg, 0);
  EXPECT_GT(*metrics.slope_min_mm_per_deg, 0) << "which the samples do not show";

  solver::PathPlanOptions finely;
  finely.end_deg = history.verdict.deploys_from_sample;
  finely.look_deg = 0.02;
  const auto fine = solver::record_history(solver::Model(base, finely), vertices_mm);
  const Eigen::Index d = history.between.bump_where;
  const Eigen::Index last = fine.length_mm.rows() - 1;
  const double sign = fine.length_mm(last, d) > fine.flat_mm[d] ? 1 : -1;
  Eigen::Index top = 1;
  while (top < last && sign * (fine.length_mm(top, d) - fine.length_mm(top - 1, d)) > 0) ++top;
  EXPECT_NEAR(fine.stations[top - 1].pilot_deg, *metrics.bump_deg, 0.05);
  const double back_mm = sign * (fine.length_mm(top - 1, d) - fine.length_mm(last, d));
  EXPECT_LT(back_mm, 0) << "and on again";

  // Where going back is a fault, this draw is none of the accepted.
  Json strict = campaign;
  strict["accept"]["deploys_from_deg"] = 160;
  EXPECT_EQ(static_cast<int>(*metrics.bump_deg), 159);
  for (const Json& rule : {Json(true), Json("exact")}) {
    strict["accept"]["between_samples"] = rule;
    DrawEvaluator strict_evaluator(schema::read_campaign(strict, "a test"));
    const solver::Verdict verdict = strict_evaluator.judge({kDraw, kDraw + 1}).front();
    // It still goes back at 160 degrees, and on again only after that.
    EXPECT_EQ(verdict.first_fault, solver::Fault::reverses_between) << rule;
    EXPECT_EQ(verdict.deploys_from_sample, 159) << rule;
    EXPECT_EQ(words_of(history_of(strict_evaluator, kDraw).verdict), words_of(verdict)) << rule;
    EXPECT_FALSE(strict_evaluator.campaign().accepts(verdict)) << rule;
  }
  const auto at_160 = static_cast<Eigen::Index>(
      std::ranges::find(fine.stations, 160, &solver::Station::sample) - fine.stations.begin());
  EXPECT_LT(sign * (fine.length_mm(at_160, d) - fine.length_mm(at_160 - 1, d)), 0);
}

// A candidate whose range ends in a bump, found by a campaign of 20,000 draws, has that as its
// bump_deg; here against the lengths every hundredth of a degree.
TEST(DrawEvaluator, BumpThatIsTheFaultIsItsBump) {
  const Json campaign = {{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                         {"accept", {{"deploys_from_deg", 150}, {"between_samples", "exact"}}}};
  DrawEvaluator evaluator(schema::read_campaign(campaign, "a test"));
  constexpr std::uint64_t kDraw = 11162;
  const auto candidates = work_off(evaluator, {kDraw, kDraw + 1}).candidates;
  ASSERT_EQ(candidates.size(), 1u);
  ASSERT_TRUE(candidates[0].metrics.bump_deg);
  const solver::FoldingHistory history = history_of(evaluator, kDraw);
  ASSERT_EQ(history.verdict.first_fault, solver::Fault::bump);
  EXPECT_EQ(history.between.bump_where, history.verdict.where);
  EXPECT_NEAR(history.between.bump_deg, *candidates[0].metrics.bump_deg, 1e-3);

  const solver::PerforatedSheet& base = evaluator.campaign().pattern.base;
  const int sample = history.verdict.deploys_from_sample;
  solver::PathPlanOptions finely;
  finely.end_deg = sample + 1;
  finely.look_deg = 0.01;
  const auto fine = solver::record_history(solver::Model(base, finely),
                                           base.sheet.vertices_mm + evaluator.shifts_mm(kDraw));
  const Eigen::Index d = history.verdict.where, last = fine.length_mm.rows() - 1;
  auto row = static_cast<Eigen::Index>(
      std::ranges::find(fine.stations, sample, &solver::Station::sample) - fine.stations.begin());
  const double sign = fine.length_mm(last, d) > fine.length_mm(row, d) ? 1 : -1;
  const auto goes_on = [&](Eigen::Index k) {
    return sign * (fine.length_mm(k + 1, d) - fine.length_mm(k, d)) > 0;
  };
  EXPECT_TRUE(goes_on(row));
  while (row < last - 1 && goes_on(row)) ++row;
  EXPECT_NEAR(fine.stations[static_cast<std::size_t>(row)].pilot_deg,
              *candidates[0].metrics.bump_deg, 0.01);
  EXPECT_TRUE(goes_on(last - 1)) << "and on again";
}

// A stop that is asked for keeps those draws whose springs would hold it as stiffly: by the slopes
// of the histories of all that deploy.
TEST(DrawEvaluator, KeepsStiffStops) {
  constexpr schema::DrawRange kDraws{0, 60};
  constexpr int kStop_deg = 60;
  DrawEvaluator without(miura_4x4());
  std::vector<std::pair<double, std::uint64_t>> by_stiffness;
  for (const auto& candidate : work_off(without, kDraws).candidates) {
    const auto history = history_of(without, candidate.draw);
    by_stiffness.emplace_back(
        (history.slope_mm_per_deg.row(kStop_deg - 1) / solver::kRadPerDeg).squaredNorm(),
        candidate.draw);
  }
  std::sort(by_stiffness.begin(), by_stiffness.end());
  ASSERT_GT(by_stiffness.size(), 8u);
  const std::size_t soft = by_stiffness.size() / 2;
  schema::Campaign campaign = miura_4x4();
  campaign.required_stop = {kStop_deg,
                            std::sqrt(by_stiffness[soft - 1].first * by_stiffness[soft].first)};
  std::set<std::uint64_t> expected, kept;
  for (std::size_t k = soft; k < by_stiffness.size(); ++k) expected.insert(by_stiffness[k].second);
  DrawEvaluator stopping(campaign);
  const schema::UnitRecord unit = work_off(stopping, kDraws);
  for (const auto& candidate : unit.candidates) kept.insert(candidate.draw);
  EXPECT_EQ(kept, expected);
  const auto soft_ones =
      unit.screened.find({static_cast<int>(solver::Fault::soft_stop), kStop_deg});
  ASSERT_NE(soft_ones, unit.screened.end());
  EXPECT_GE(soft_ones->second, soft) << "and others that do not reach the threshold";
  EXPECT_EQ(unit.accepted + unit.rejected, kDraws.size());
}

// The same draws in the registers of every instruction set of this machine, and in other blocks.
TEST(DrawEvaluator, InstructionSetsAndBlocksAgreeSlow) {
  const auto draws_of = [](const schema::UnitRecord& unit) {
    std::vector<std::pair<std::uint64_t, int>> draws;
    for (const auto& candidate : unit.candidates) {
      draws.emplace_back(candidate.draw, candidate.metrics.deploys_from_sample);
    }
    return draws;
  };
  DrawEvaluator widest(miura_4x4());
  const auto expected = draws_of(work_off(widest, {500, 900}));
  EXPECT_GT(expected.size(), 100u);
  for (const auto set : solver::available_instruction_sets()) {
    DrawEvaluator evaluator(miura_4x4(), set);
    schema::UnitRecord unit;
    for (std::uint64_t lo = 500; lo < 900; lo += 57) {
      evaluator.evaluate({lo, std::min<std::uint64_t>(lo + 57, 900)}, unit,
                         schema::FaultSampleRule(), [&](std::size_t) { return lo % 2 == 0; });
    }
    evaluator.evaluate({900, 900}, unit, schema::FaultSampleRule(),
                       [](std::size_t) { return true; });
    EXPECT_EQ(draws_of(unit), expected) << solver::instruction_set_name(set);
  }
}

// Next to a fold limit lengths change ever faster with the pilot. Whether a diagonal goes back
// there, in draws of the main campaign with a limit up to 0.05 degrees beyond D, is what the same
// path says in steps of a hundredth of a degree. None of them goes on again before D, which would
// be a bump.
TEST(DrawEvaluator, TurnsNextToAFoldLimitAreThoseOfTheFinePathSlow) {
  const schema::Campaign campaign = schema::read_campaign(
      {{"pattern", {{"family", "miura"}, {"rows", 6}, {"columns", 6}}}}, "a test");
  FoldingModel coarse(campaign), fine(campaign, 0.01);
  int turns = 0, smooth = 0;
  for (const std::uint64_t draw : {2850319, 4366571, 9947173, 10337263, 1623437, 8100241}) {
    const Eigen::Matrix2Xd shifts_mm = shifts_of_draw(campaign, draw);
    const solver::Metrics metrics = *coarse.sheet(shifts_mm).metrics();
    const solver::FoldingHistory history = fine.sheet(shifts_mm).history();
    EXPECT_LT(metrics.fold_limit_deg - metrics.deploys_from_deg, 0.05) << "draw " << draw;
    bool goes_back = false;
    for (Eigen::Index d = 0; d < history.length_mm.cols(); ++d) {
      double top = 0;
      for (std::size_t row = 0; row < history.stations.size(); ++row) {
        if (history.stations[row].pilot_deg > metrics.deploys_from_deg) break;
        const double change = std::abs(history.length_mm(row, d) - history.flat_mm[d]);
        goes_back = goes_back || change < top - 80 * solver::kBumpBand_widths;
        top = std::max(top, change);
      }
    }
    EXPECT_EQ(*metrics.slope_between_min_mm_per_deg < 0, goes_back) << "draw " << draw;
    EXPECT_FALSE(metrics.bump_deg.has_value()) << "draw " << draw;
    (goes_back ? turns : smooth) += 1;
  }
  EXPECT_GE(turns, 2);
  EXPECT_GE(smooth, 3);
}

}  // namespace
}  // namespace misalign::search
