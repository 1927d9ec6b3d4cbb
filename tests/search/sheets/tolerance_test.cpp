#include "search/sheets/tolerance.hpp"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <boost/math/special_functions/beta.hpp>
#include <set>

#include "schema/campaign/campaign_file.hpp"
#include "schema/exchange/backlash_json.hpp"
#include "schema/exchange/tolerance_json.hpp"
#include "search/draws/draw.hpp"
#include "search/sheets/backlash.hpp"
#include "search/sheets/backlash_text.hpp"
#include "search/sheets/tolerance_text.hpp"
#include "solver/reference/reference.hpp"

namespace misalign::search {
namespace {

using schema::tolerance_json;
using solver::Backlash;
using solver::MiscutCopies;
using solver::Tolerance;

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
    DrawEvaluator trial(campaign());
    return work_off(trial, {0, 40}).candidates.at(2).draw;
  }
  ToleranceOptions options(double amplitude_mm, std::uint64_t trials) const {
    ToleranceOptions all;
    all.amplitude_mm = amplitude_mm;
    all.trials = trials;
    all.vertices = true;
    all.set = solver::available_instruction_sets().back();
    return all;
  }
  Eigen::Matrix2Xd shifts_mm(std::uint64_t draw) const {
    Eigen::Matrix2Xd shifts = Eigen::Matrix2Xd::Zero(2, 25);
    draw_shifts(campaign_.misalignment, campaign_.seed, draw, shifts);
    return shifts;
  }
  Tolerance study(const ToleranceOptions& options) const {
    return study_tolerance(campaign_, {shifts_mm(draw_)}, options).front();
  }
  Tolerance study(double amplitude_mm, std::uint64_t trials) const {
    return study(options(amplitude_mm, trials));
  }

  const schema::Campaign campaign_ = campaign();
  const std::uint64_t draw_ = candidate();
};

TEST_F(ToleranceTest, NoErrorNoLossSlow) {
  for (const double amplitude_mm : {0.0, 1e-9}) {
    const Tolerance tolerance = study(amplitude_mm, 20);
    EXPECT_EQ(tolerance.copies.trials, 20u);
    EXPECT_EQ(tolerance.survivors(), 20u);
    EXPECT_EQ(tolerance.mean_loss_deg(tolerance.copies), 0);
    EXPECT_EQ(tolerance.vertices.size(), 25u);
    for (const solver::Tolerance::Vertex& vertex : tolerance.vertices) {
      EXPECT_EQ(vertex.copies.from(150), 20u);
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

// How many there are of each, up to the largest.
std::vector<std::uint64_t> counted(const std::vector<int>& samples) {
  std::vector<std::uint64_t> counts(
      static_cast<std::size_t>(*std::max_element(samples.begin(), samples.end())) + 1);
  for (const int sample : samples) ++counts[static_cast<std::size_t>(sample)];
  return counts;
}

// Every trial by itself: the dense reference on the sheet put together here.
TEST_F(ToleranceTest, TrialsAreTheReferencesSlow) {
  const Tolerance tolerance = study(kAmplitude_mm, kTrials);
  const solver::PerforatedSheet& base = campaign_.pattern.base;
  const auto mechanism = solver::build_mechanism(base);
  const auto plan =
      solver::plan_path(mechanism, base.folding, base.sheet.vertices_mm, campaign_.path());
  solver::Reference reference(mechanism, plan);
  const auto sample_of = [&](const Eigen::Matrix2Xd& errors_mm) {
    return reference.judge(base.sheet.vertices_mm + (shifts_mm(draw_) + errors_mm))
        .deploys_from_sample;
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
  EXPECT_EQ(tolerance.copies.of_sample, counted(samples));
  EXPECT_EQ(tolerance.vertices.front().copies.of_sample, counted(of_one));
  const auto from = [&](int sample) {
    return static_cast<std::uint64_t>(samples.end() -
                                      std::lower_bound(samples.begin(), samples.end(), sample));
  };
  EXPECT_EQ(tolerance.survivors(), from(150));
  EXPECT_EQ(tolerance.copies.from(tolerance.own_sample), from(tolerance.own_sample));
  // The errors do matter, one vertex's too.
  EXPECT_GT(std::set<int>(samples.begin(), samples.end()).size(), 3u);
  EXPECT_GT(std::set<int>(of_one.begin(), of_one.end()).size(), 1u);
  EXPECT_EQ(tolerance.copies.quantile(0), samples.front());
  EXPECT_EQ(tolerance.copies.quantile(0.5), samples[kTrials / 2 - 1]);
  EXPECT_EQ(tolerance.copies.quantile(1), samples.back());
}

// How a sheet is asked for its own D, before there is a threshold: by none of its copies.
// Every copy without errors stops where the springs are relaxed; with errors each trial has the
// stop of its own, whatever other trials and threads there are; and no stop is asked of flat
// springs.
TEST_F(ToleranceTest, StopsAreThoseOfTheTrials) {
  ToleranceOptions asked = options(1e-9, 8);
  asked.vertices = false;
  asked.filled.fill = solver::Springs{.rest_deg = 60};
  const Tolerance exact = study(asked);
  EXPECT_EQ(exact.rest_deg, 60);
  const auto stops_deg = [](const solver::MiscutStops& stops) {
    return stops.sorted(&solver::Stop::at_deg);
  };
  EXPECT_NEAR(exact.own_stop->at_deg, 60, 1e-3);
  ASSERT_EQ(exact.copies.stops.stops.size(), 8u);
  for (const double at_deg : stops_deg(exact.copies.stops)) EXPECT_NEAR(at_deg, 60, 1e-3);

  asked.amplitude_mm = kAmplitude_mm;
  asked.trials = 300;  // more than are judged together
  EXPECT_EQ(study(asked).copies.stops.trials(), 300u);
  const std::vector<double> all = stops_deg(study(asked).copies.stops);
  EXPECT_GT(solver::quantile(all, 0.95) - solver::quantile(all, 0.05), 0.1);
  asked.jobs = 3;
  EXPECT_EQ(stops_deg(study(asked).copies.stops), all);
  asked.trials = 8;
  for (const double at_deg : stops_deg(study(asked).copies.stops)) {
    EXPECT_TRUE(std::ranges::binary_search(all, at_deg)) << at_deg;
  }
  EXPECT_EQ(tolerance_json(study(asked))["stops"]["quantiles"].size(),
            std::size(solver::kShownShares));

  // Threads change no value of stops with friction and a target, a plane here.
  schema::Campaign shaped = campaign_;
  solver::WantedShape plane;
  plane.surface = solver::plane();
  shaped.target = std::make_shared<const schema::Target>(
      schema::Target{.shape = plane, .at_deg = 60, .json = {}, .mesh = nullptr});
  asked.filled.friction = [](const solver::Sheet&) { return 0.01; };
  asked.trials = 300;
  const auto values_with = [&](int jobs) {
    asked.jobs = jobs;
    const Tolerance found = study_tolerance(shaped, {shifts_mm(draw_)}, asked).front();
    EXPECT_TRUE(found.has_shapes);
    std::vector<std::vector<double>> values;
    for (const auto value : {&solver::Stop::at_deg, &solver::Stop::held_from_deg,
                             &solver::Stop::shape_rms_mm, &solver::Stop::shape_max_mm}) {
      values.push_back(found.copies.stops.sorted(value));
      EXPECT_LT(values.back().front(), values.back().back());
    }
    return values;
  };
  EXPECT_EQ(values_with(1), values_with(3));
  asked.filled.friction = nullptr;
  asked.trials = 8;

  // Pre-stretched plates drive it flat, whatever their rest.
  asked.filled.fill = solver::RubberPlates{.prestretch = 1.2, .rest_deg = 60};
  asked.amplitude_mm = 1e-9;
  EXPECT_EQ(study(asked).own_stop->at_deg, 0);
  EXPECT_EQ(study(asked).copies.stops.flat, 8u);
  asked.filled.fill = solver::Springs{.rest_deg = 60, .preload = {.each_n = 1}};
  EXPECT_THROW(study(asked), schema::UserError);

  asked.filled.fill = solver::Springs{};
  EXPECT_EQ(study(asked).copies.stops.trials(), 0u);
  asked.filled.fill = solver::Springs{.rest_deg = 179.9};
  EXPECT_THROW(study(asked), schema::UserError);
}

TEST_F(ToleranceTest, OwnAngleNeedsNoCopies) {
  ToleranceOptions none = options(kAmplitude_mm, 0);
  none.vertices = false;
  schema::Campaign low = campaign_;
  low.threshold_deg = low.sample_deg;
  const Tolerance itself = study_tolerance(low, {shifts_mm(draw_)}, none).front();
  EXPECT_EQ(itself.own_sample, study(kAmplitude_mm, 5).own_sample);
  EXPECT_GE(itself.own_sample, campaign_.threshold_sample());
  EXPECT_EQ(itself.copies.trials, 0u);
}

TEST_F(ToleranceTest, MostHarmfulVerticesFirstSlow) {
  const Tolerance tolerance = study(kAmplitude_mm, kTrials);
  for (std::size_t k = 1; k < tolerance.vertices.size(); ++k) {
    const MiscutCopies& before = tolerance.vertices[k - 1].copies;
    const MiscutCopies& copies = tolerance.vertices[k].copies;
    EXPECT_LE(before.from(150), copies.from(150));
    if (before.from(150) == copies.from(150)) {
      EXPECT_GE(tolerance.mean_loss_deg(before), tolerance.mean_loss_deg(copies));
    }
  }
}

TEST_F(ToleranceTest, InstructionSetsAgreeSlow) {
  const Tolerance expected = study(kAmplitude_mm, 30);
  for (const auto set : solver::available_instruction_sets()) {
    ToleranceOptions other = options(kAmplitude_mm, 30);
    other.set = set;
    EXPECT_EQ(tolerance_json(study(other)), tolerance_json(expected))
        << solver::instruction_set_name(set);
  }
}

// Several sheets on several threads give what each gives alone on one; all copies are reported.
TEST_F(ToleranceTest, ThreadsAndCompanyDoNotMatterSlow) {
  const std::vector<std::uint64_t> draws = {draw_, 0, 1, 2};
  std::vector<Eigen::Matrix2Xd> sheets;
  for (const std::uint64_t draw : draws) sheets.push_back(shifts_mm(draw));
  ToleranceOptions alone = options(kAmplitude_mm, 300);
  alone.vertices = false;
  ToleranceOptions together = alone;
  together.jobs = 3;
  CopiesDone last{0, 0};
  together.progress = [&](const CopiesDone& copies) {
    EXPECT_GT(copies.done, last.done);
    last = copies;
  };
  const std::vector<Tolerance> several = study_tolerance(campaign_, sheets, together);
  ASSERT_EQ(several.size(), draws.size());
  EXPECT_EQ(last.done, 4u * 300);
  EXPECT_EQ(last.all, 4u * 300);
  for (std::size_t k = 0; k < draws.size(); ++k) {
    const Tolerance one = study_tolerance(campaign_, {sheets[k]}, alone).front();
    EXPECT_EQ(tolerance_json(several[k]), tolerance_json(one)) << "draw " << draws[k];
    EXPECT_EQ(one.copies.trials, 300u);
    EXPECT_TRUE(one.vertices.empty()) << "not asked for";
  }
}

// The share by each trial alone; the largest play whatever was asked about, good by itself and not
// much larger; on any number of threads.
TEST_F(ToleranceTest, BacklashIsThatOfItsTrials) {
  constexpr std::uint64_t kFew = 20;
  const BacklashStudy study(campaign_, {shifts_mm(draw_)}, {});
  CopiesDone last{0, 0};
  const auto watch = [&](const CopiesDone& copies) { last = copies; };
  const Backlash backlash = study.run({0.02, kFew, 1, watch}).front();
  EXPECT_EQ(last.done, last.all);
  EXPECT_EQ(backlash.undecided(), 0u);
  const solver::BacklashStart& sheet = study.sheets().front();
  const solver::Model model(campaign_.pattern.base, campaign_.path());
  solver::BacklashFollower follower(model, sheet, {});
  const auto one_way = [&](double backlash_mm) {
    std::uint64_t count = 0;
    for (std::uint64_t trial = 0; trial < kFew; ++trial) {
      const auto offsets = trial_offsets(model.mechanism(), campaign_.seed, trial);
      count += follower.trial(offsets, backlash_mm / 80, true).moves_one_way();
    }
    return count;
  };
  EXPECT_EQ(backlash.one_way_to(backlash.to_deg), one_way(0.02));
  EXPECT_GE(one_way(backlash.largest_mm), 19u);
  EXPECT_EQ(one_way(backlash.largest_mm), backlash.with_largest);
  EXPECT_LT(one_way(backlash.largest_mm * kRadiusRatio), 19u);
  const Backlash other = study.run({0.04, kFew, 3, {}}).front();
  EXPECT_EQ(other.largest_mm, backlash.largest_mm);
  EXPECT_EQ(other.one_way_to(other.own_deg), one_way(0.04));
  const std::string text = backlash_text({"draw 17", backlash, campaign_.threshold_deg});
  EXPECT_NE(text.substr(text.rfind('\n', text.size() - 2)).find("95 % clearance"),
            std::string::npos)
      << text;
  EXPECT_EQ(schema::backlash_json(backlash, 150)["one_way"]["trials"], one_way(0.02));
}

// What counts is said last, in words too.
TEST_F(ToleranceTest, TheAnswerComesLast) {
  const Tolerance tolerance = study(kAmplitude_mm, 20);
  const std::string text = tolerance_text({"draw 17", tolerance});
  const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
  EXPECT_EQ(last.find("yield from 150 "), 0u) << text;
  EXPECT_LT(text.find("one vertex alone"), text.find("draw 17"));
  Tolerance worse = tolerance;
  worse.copies = {};
  worse.copies.add({0, solver::Fault::not_monotone, 0});
  for (const bool first : {false, true}) {
    std::vector<NamedTolerance> both = {{"draw 17", tolerance}, {"draw 3", worse}};
    if (first) std::swap(both[0], both[1]);
    const std::string lines = tolerances_text(both);
    EXPECT_EQ(lines.substr(lines.rfind('\n', lines.size() - 2) + 1).find("draw 17"), 0u) << lines;
  }
}

// The undecided ones are none of the share, and may be anything in its interval: here against the
// beta distribution whose quantiles Clopper and Pearson's bounds are.
TEST(MiscutCopies, UndecidedOnesBoundBothWays) {
  MiscutCopies copies;
  for (int k = 0; k < 10; ++k) {
    copies.add({k < 6 ? 160 : 100, solver::Fault::not_monotone, 0});
  }
  for (int k = 0; k < 2; ++k) copies.add({3, solver::Fault::undecided});
  EXPECT_EQ(copies.trials, 12u);
  EXPECT_EQ(copies.undecided, 2u);
  const schema::ShareOfTrials share = schema::share_of(copies.from(150), copies);
  EXPECT_DOUBLE_EQ(share.share, 0.6);
  EXPECT_NEAR(share.low, boost::math::ibeta_inv(6, 7, 0.025), 1e-12);
  EXPECT_NEAR(share.high, boost::math::ibeta_inv(9, 4, 0.975), 1e-12);
  EXPECT_EQ(copies.from(170), 0u);
  EXPECT_DOUBLE_EQ(copies.mean_sample(), 136);
}

}  // namespace
}  // namespace misalign::search
