#include "search/tolerance.hpp"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <boost/math/special_functions/beta.hpp>
#include <set>

#include "search/draw.hpp"
#include "solver/reference.hpp"

namespace misalign::search {
namespace {

constexpr double kAmplitude_mm = 0.1;
constexpr std::uint64_t kTrials = 60;

class ToleranceTest : public testing::Test {
 protected:
  static schema::Campaign campaign() {
    return schema::read_campaign({{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                                  {"accept", {{"deploys_from_deg", 150}}},
                                  {"seed", 7u}},
                                 "a test");
  }
  /// A draw that deploys from the threshold.
  static std::uint64_t candidate() {
    Trial trial(campaign());
    schema::UnitRecord unit;
    trial.screen({0, 40}, unit);
    trial.settle(unit);
    return unit.candidates.at(2).draw;
  }
  Tolerance study(double amplitude_mm, std::uint64_t trials,
                  solver::InstructionSet set = solver::available_instruction_sets().back()) const {
    return study_tolerance(campaign_, draw_, amplitude_mm, trials, set);
  }

  const schema::Campaign campaign_ = campaign();
  const std::uint64_t draw_ = candidate();
};

TEST_F(ToleranceTest, NoErrorNoLoss) {
  for (const double amplitude_mm : {0.0, 1e-9}) {
    const Tolerance tolerance = study(amplitude_mm, 20);
    EXPECT_EQ(tolerance.copies.trials, 20u);
    EXPECT_EQ(tolerance.copies.from_threshold, 20u);
    EXPECT_EQ(tolerance.mean_loss_deg(tolerance.copies), 0);
    EXPECT_EQ(tolerance.vertices.size(), 25u);
    for (const VertexTolerance& vertex : tolerance.vertices) {
      EXPECT_EQ(vertex.copies.from_threshold, 20u);
      EXPECT_EQ(tolerance.mean_loss_deg(vertex.copies), 0);
    }
  }
}

// Stream 1 of the generator, used directly.
TEST_F(ToleranceTest, ErrorsAreStreamOne) {
  for (const std::uint64_t trial : {std::uint64_t{0}, (std::uint64_t{5} << 32) + 3}) {
    Eigen::Matrix2Xd errors_mm(2, 25);
    trial_errors(campaign_, kAmplitude_mm, trial, errors_mm.data());
    for (std::uint32_t k = 0; k < 50; ++k) {
      const r123::Philox4x32::ctr_type counter = {
          {static_cast<std::uint32_t>(trial), static_cast<std::uint32_t>(trial >> 32), k / 4, 1}};
      const auto words = r123::Philox4x32{}(counter, {{7, 0}});
      const double expected_mm = ((words[k % 4] + 0.5) / 2147483648.0 - 1) * kAmplitude_mm;
      EXPECT_EQ(errors_mm.data()[k], expected_mm) << "trial " << trial << ", word " << k;
    }
  }
}

// Every trial by itself: the dense reference on the sheet put together here.
TEST_F(ToleranceTest, TrialsAreTheReferences) {
  const Tolerance tolerance = study(kAmplitude_mm, kTrials);
  const solver::PerforatedSheet& base = campaign_.pattern.base;
  const auto mechanism = solver::build_mechanism(base.sheet, base.holes, base.folding);
  const auto plan =
      solver::plan_path(mechanism, base.folding, base.sheet.vertices_mm, campaign_.path());
  solver::Reference reference(mechanism, plan);
  Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, 25);
  draw_shifts(campaign_.misalignment, campaign_.seed, draw_, shifts_mm);
  const auto sample_of = [&](const Eigen::Matrix2Xd& errors_mm) {
    return reference.judge(base.sheet.vertices_mm + (shifts_mm + errors_mm)).deploys_from_sample;
  };
  EXPECT_EQ(tolerance.own_sample, sample_of(Eigen::Matrix2Xd::Zero(2, 25)));

  const int most_harmful = tolerance.vertices.front().vertex;
  std::vector<int> samples, of_one;
  for (std::uint64_t trial = 0; trial < kTrials; ++trial) {
    Eigen::Matrix2Xd errors_mm(2, 25);
    trial_errors(campaign_, kAmplitude_mm, trial, errors_mm.data());
    samples.push_back(sample_of(errors_mm));
    Eigen::Matrix2Xd one_mm = Eigen::Matrix2Xd::Zero(2, 25);
    one_mm.col(most_harmful) = errors_mm.col(most_harmful);
    of_one.push_back(sample_of(one_mm));
  }
  for (std::vector<int>* list : {&samples, &of_one}) std::sort(list->begin(), list->end());
  EXPECT_EQ(tolerance.copies.samples, samples);
  EXPECT_EQ(tolerance.vertices.front().copies.samples, of_one);
  const auto from = [&](int sample) {
    return static_cast<std::uint64_t>(samples.end() -
                                      std::lower_bound(samples.begin(), samples.end(), sample));
  };
  EXPECT_EQ(tolerance.copies.from_threshold, from(150));
  EXPECT_EQ(tolerance.copies.from_own, from(tolerance.own_sample));
  // The errors do matter, one vertex's too.
  EXPECT_GT(std::set<int>(samples.begin(), samples.end()).size(), 3u);
  EXPECT_GT(std::set<int>(of_one.begin(), of_one.end()).size(), 1u);
  EXPECT_EQ(tolerance.copies.quantile(0), samples.front());
  EXPECT_EQ(tolerance.copies.quantile(0.5), samples[kTrials / 2 - 1]);
  EXPECT_EQ(tolerance.copies.quantile(1), samples.back());
}

TEST_F(ToleranceTest, MostHarmfulVerticesFirst) {
  const Tolerance tolerance = study(kAmplitude_mm, kTrials);
  for (std::size_t k = 1; k < tolerance.vertices.size(); ++k) {
    const MiscutCopies& before = tolerance.vertices[k - 1].copies;
    const MiscutCopies& copies = tolerance.vertices[k].copies;
    EXPECT_LE(before.from_threshold, copies.from_threshold);
    if (before.from_threshold == copies.from_threshold) {
      EXPECT_GE(tolerance.mean_loss_deg(before), tolerance.mean_loss_deg(copies));
    }
  }
}

TEST_F(ToleranceTest, InstructionSetsAgree) {
  const Tolerance expected = study(kAmplitude_mm, 30);
  for (const auto set : solver::available_instruction_sets()) {
    const Tolerance tolerance = study(kAmplitude_mm, 30, set);
    EXPECT_EQ(tolerance_json(tolerance), tolerance_json(expected))
        << solver::instruction_set_name(set);
  }
}

// The undecided ones are none of the share, and may be anything in its interval: here against the
// beta distribution whose quantiles Clopper and Pearson's bounds are.
TEST(MiscutCopies, UndecidedOnesBoundBothWays) {
  MiscutCopies copies;
  for (int k = 0; k < 10; ++k) {
    copies.add({k < 6 ? 160 : 100, solver::Fault::not_monotone, 0}, 150, 170);
  }
  for (int k = 0; k < 2; ++k) copies.add({3, solver::Fault::undecided}, 150, 170);
  EXPECT_EQ(copies.trials, 12u);
  EXPECT_EQ(copies.undecided, 2u);
  const ShareOfTrials share = share_of(copies.from_threshold, copies);
  EXPECT_DOUBLE_EQ(share.share, 0.6);
  EXPECT_NEAR(share.low, boost::math::ibeta_inv(6, 7, 0.025), 1e-12);
  EXPECT_NEAR(share.high, boost::math::ibeta_inv(9, 4, 0.975), 1e-12);
  EXPECT_EQ(copies.from_own, 0u);
  EXPECT_DOUBLE_EQ(copies.mean_sample(), 136);
}

TEST_F(ToleranceTest, ErrorsThatCanBendFacetsInAreRefused) {
  try {
    study(45, 10);
    FAIL() << "not refused";
  } catch (const schema::UserError& error) {
    EXPECT_EQ(error.exit_code(), 2);
    EXPECT_NE(std::string(error.what()).find("--amplitude 45: must be below"), std::string::npos);
  }
}

}  // namespace
}  // namespace misalign::search
