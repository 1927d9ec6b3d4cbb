// The rate of one campaign three times: by OpenTURNS' subset sampling on the same scores, by
// splitting, and by plain draws (results/splitting/openturns.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/CompositeRandomVector.hxx>
#include <openturns/EvaluationImplementation.hxx>
#include <openturns/Exception.hxx>
#include <openturns/GreaterOrEqual.hxx>
#include <openturns/RandomGenerator.hxx>
#include <openturns/SubsetSampling.hxx>
#include <openturns/TBB.hxx>
#include <openturns/ThresholdEvent.hxx>
#include <openturns/Uniform.hxx>

#include "schema/campaign/campaign_file.hpp"
#include "schema/campaign/split_rate.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/splitting/climber.hpp"
#include "tests/bench/climbed_to_top.hpp"
#include "tests/bench/cpu_seconds.hpp"
#include "tests/bench/plain_draws.hpp"
#include "tests/bench/share_intervals.hpp"

namespace misalign::search {
namespace {

struct StudyOptions {
  std::string campaign;
  bool is_ternary = false;
  double threshold_deg = 175;
  schema::Splitting splitting{.levels_deg = {}, .particles = 60, .sweeps = 3, .first_draws = 300};
  std::uint32_t populations = 400;
  std::uint64_t runs = 100, points = 1000, at_once = 100, plain_draws = 1000000;
};

struct Effort {
  std::uint64_t evaluations = 0, undecided = 0;
};

// The score of a sheet whose shifts are uniform on [-1, 1], in amplitudes; of a ternary campaign
// the thirds of that are its three levels. An undecided one lies in no level.
class Scores : public OT::EvaluationImplementation {
 public:
  Scores(const schema::Campaign& campaign, LevelScorer& judge, Effort& effort)
      : campaign_(campaign), scorer_(judge), effort_(effort) {}
  Scores* clone() const override { return new Scores(*this); }
  OT::UnsignedInteger getInputDimension() const override {
    return 2 * campaign_.misalignment.vertices.size();
  }
  OT::UnsignedInteger getOutputDimension() const override { return 1; }

  using OT::EvaluationImplementation::operator();
  OT::Point operator()(const OT::Point& sheet) const override {
    return (*this)(OT::Sample(1, sheet))[0];
  }
  OT::Sample operator()(const OT::Sample& sheets) const override {
    const auto count = sheets.getSize();
    solver::ShiftBlock block{{}, static_cast<int>(count)};
    for (OT::UnsignedInteger k = 0; k < count; ++k) {
      for (OT::UnsignedInteger i = 0; i < sheets.getDimension(); ++i) {
        block.shifts_mm.push_back(campaign_.misalignment.amplitude_mm * shift(sheets(k, i)));
      }
    }
    const std::vector<int>& found = scorer_.score(block);
    OT::Sample scores(count, 1);
    for (OT::UnsignedInteger k = 0; k < count; ++k) {
      scores(k, 0) = found[k];
      effort_.undecided += found[k] == kUndecided;
    }
    effort_.evaluations += count;
    return scores;
  }

 private:
  double shift(double share) const {
    if (campaign_.misalignment.distribution == schema::ShiftDistribution::uniform) return share;
    return share < -1.0 / 3 ? -1 : share > 1.0 / 3 ? 1 : 0;
  }

  const schema::Campaign& campaign_;
  LevelScorer& scorer_;
  Effort& effort_;
};

// Estimates that are independent and of one law, and what they cost together.
void print_estimates(const char* method, const std::vector<double>& estimates,
                     std::uint64_t evaluations, double seconds) {
  const bench::SampleMoments of = bench::sample_moments(estimates);
  const auto n = static_cast<double>(estimates.size()), all = static_cast<double>(evaluations);
  const double variation = of.error * std::sqrt(n) / of.mean;
  fmt::print(
      "{}: {} estimates, mean {:.4e} +- {:.1e} ({:.2f} %); of one: coefficient of variation "
      "{:.3f}, {:.0f} evaluations, {:.3f} CPU s; for 10 %: {:.0f} evaluations, {:.2f} CPU s\n",
      method, estimates.size(), of.mean, of.error, 100 * of.error / of.mean, variation, all / n,
      seconds / n, 100 * variation * variation * all / n,
      100 * variation * variation * seconds / n);
}

void sample_subsets(const StudyOptions& options, const schema::Campaign& campaign) {
  OT::TBB::Disable();
  LevelScorers scorers(campaign, solver::available_instruction_sets().back());
  Effort effort;
  const Scores scores(campaign, scorers.from(0), effort);
  const OT::ComposedDistribution law(OT::ComposedDistribution::DistributionCollection(
      scores.getInputDimension(), OT::Uniform(-1, 1)));
  const OT::CompositeRandomVector score{OT::Function(scores), OT::RandomVector(law)};
  const OT::ThresholdEvent event(score, OT::GreaterOrEqual(), last_level(campaign));
  std::vector<double> estimates, said;
  double steps = 0;
  const double start_s = bench::cpu_seconds();
  for (std::uint64_t seed = 1; seed <= options.runs; ++seed) {
    OT::RandomGenerator::SetSeed(seed);
    OT::SubsetSampling sampling(event);
    sampling.setBlockSize(options.at_once);
    sampling.setMaximumOuterSampling(options.points / options.at_once);
    try {
      sampling.run();
      said.push_back(sampling.getResult().getCoefficientOfVariation());
    } catch (const OT::InvalidArgumentException& refusal) {
      // Its variance came out below 0, after the last step: the estimate is there. To leave it out
      // would choose among estimates.
      if (sampling.getThresholdPerStep()[sampling.getStepsNumber() - 1] != event.getThreshold()) {
        throw;
      }
    }
    estimates.push_back(sampling.getProbabilityEstimatePerStep()[sampling.getStepsNumber() - 1]);
    steps += static_cast<double>(sampling.getStepsNumber());
  }
  print_estimates("OpenTURNS", estimates, effort.evaluations, bench::cpu_seconds() - start_s);
  fmt::print("  {:.2f} steps, {} undecided; {} runs without a variance, the others say {:.3f}\n",
             steps / static_cast<double>(options.runs), effort.undecided,
             options.runs - said.size(), bench::sample_moments(said).mean);
}

void split(const StudyOptions& options, const schema::Campaign& campaign) {
  Climber climber(campaign, solver::available_instruction_sets().back());
  const Ladder ladder = ladder_of(campaign, climber);
  std::vector<double> shares;
  std::uint64_t evaluations = 0;
  const double start_s = bench::cpu_seconds();
  for (std::uint32_t number = 0; number < options.populations; ++number) {
    const PopulationRecord record = bench::climbed_to_top(ladder, number, climber);
    shares.push_back(record.share(ladder.top()));
    for (const schema::LevelCount& level : record.levels) evaluations += level.tried;
  }
  print_estimates("splitting", shares, evaluations, bench::cpu_seconds() - start_s);
  const schema::SplitRate rate = schema::split_rate(shares);
  fmt::print("  {} levels, {} populations reach the top", ladder.top(), rate.reached);
  if (rate.interval) fmt::print(", {:.4e} to {:.4e}", rate.interval->low, rate.interval->high);
  fmt::print("\n");
}

void draw_plainly(const StudyOptions& options, const schema::Campaign& campaign) {
  schema::Campaign plain = campaign;
  plain.seed = 0;
  DrawEvaluator evaluator(plain, solver::available_instruction_sets().back());
  const double start_s = bench::cpu_seconds();
  const auto [accepted, undecided] =
      bench::count_plain_draws(evaluator, options.plain_draws, [](const schema::UnitRecord&) {});
  const double seconds = bench::cpu_seconds() - start_s;
  const auto draws = static_cast<double>(options.plain_draws), hits = static_cast<double>(accepted);
  const double share = hits / draws, for_ten = 100 * (1 - share) / share;
  fmt::print(
      "plain: {} of {} draws, {:.4e} +- {:.1e} ({:.2f} %), {:.1f} CPU s, {} undecided; for 10 %: "
      "{:.0f} evaluations, {:.2f} CPU s\n",
      accepted, options.plain_draws, share, std::sqrt(hits) / draws, 100 / std::sqrt(hits), seconds,
      undecided, for_ten, for_ten * seconds / draws);
}

void run(const StudyOptions& options) {
  schema::Campaign campaign = schema::read_campaign_file(options.campaign);
  campaign.threshold_deg = options.threshold_deg;
  campaign.misalignment.distribution =
      options.is_ternary ? schema::ShiftDistribution::ternary : schema::ShiftDistribution::uniform;
  campaign.search.splitting = options.splitting;
  if (options.runs > 0) sample_subsets(options, campaign);
  if (options.populations > 0) split(options, campaign);
  if (options.plain_draws > 0) draw_plainly(options, campaign);
}

}  // namespace
}  // namespace misalign::search

int main(int count, char** arguments) {
  misalign::search::StudyOptions options;
  CLI::App app("The rate of a campaign by OpenTURNS, by splitting and by plain draws");
  app.add_option("campaign", options.campaign, "campaign file")->required();
  app.add_flag("--ternary", options.is_ternary, "shifts of three levels, otherwise uniform");
  app.add_option("--from", options.threshold_deg, "threshold, deg")->capture_default_str();
  app.add_option("--levels", options.splitting.levels_deg, "deg, the threshold last; or a pilot's");
  app.add_option("--particles", options.splitting.particles)->capture_default_str();
  app.add_option("--sweeps", options.splitting.sweeps)->capture_default_str();
  app.add_option("--first-draws", options.splitting.first_draws)->capture_default_str();
  app.add_option("--populations", options.populations)->capture_default_str();
  app.add_option("--runs", options.runs, "of OpenTURNS, seeds 1, 2, ...")->capture_default_str();
  app.add_option("--points", options.points, "of each of its steps")->capture_default_str();
  app.add_option("--at-once", options.at_once,
                 "points that are evaluated together; divides a tenth of them")
      ->capture_default_str();
  app.add_option("--plain-draws", options.plain_draws)->capture_default_str();
  CLI11_PARSE(app, count, arguments);
  misalign::search::run(options);
}
