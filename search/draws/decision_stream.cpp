#include "search/draws/decision_stream.hpp"

#include <cassert>
#include <cmath>
#include <limits>

#include "schema/pattern/perforation_check.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {

solver::Verdict before_closing(const solver::Model& model, const Eigen::Matrix2Xd& shifts_mm,
                               const solver::Verdict& verdict) {
  const solver::Station& end = model.path().stations.back();
  const int last = end.sample - 1;
  if (end.pilot_deg < 180 || last < 1 || verdict.deploys_from_sample < last ||
      !schema::closes_at_180(model.base(), shifts_mm)) {
    return verdict;
  }
  return {last};
}

int threshold_sample_of(double threshold_deg, const schema::Sampling& sampling) {
  const double samples = threshold_deg / sampling.sample_deg;
  const auto refuse = [&](const std::string& why) {
    const double whole = std::isfinite(samples) ? std::max(1.0, std::round(samples)) : 1;
    const double most = std::floor(sampling.end_deg / sampling.sample_deg * (1 + 1e-9));
    throw schema::UserError(solver::OptionFault{
        "threshold_deg", schema::shown_number(threshold_deg), why,
        "try " + schema::shown_number(std::min(whole, most) * sampling.sample_deg)});
  };
  const bool is_whole = std::abs(samples - std::round(samples)) <= 1e-9 * std::abs(samples);
  if (!(threshold_deg > 0) || !is_whole) {
    refuse("must be a whole multiple of sample_deg = " + schema::shown_number(sampling.sample_deg));
  }
  if (threshold_deg > sampling.end_deg * (1 + 1e-9)) {
    refuse("must lie within the path, which ends at " + schema::shown_number(sampling.end_deg) +
           " degrees");
  }
  return static_cast<int>(std::lround(samples));
}

DecisionStream::DecisionStream(const solver::Model& model, solver::Batch& batch)
    : model_(model),
      batch_(batch),
      block_size_(largest_block(model)),
      seconds_per_path_(std::numeric_limits<double>::infinity()) {}

Decision DecisionStream::decision_of(const solver::Verdict& verdict) const {
  if (verdict.first_fault == solver::Fault::undecided) return Decision::undecided;
  const bool reaches = verdict.deploys_from_sample >= model_.threshold_sample();
  return reaches ? Decision::accepted : Decision::rejected;
}

void DecisionStream::accept(const Draws& block, const TellDecision& tell) {
  constexpr double kPaths_s = 0.08;
  const Stopwatch watch;
  const std::vector<solver::Rejection>& seen = batch_.reject(block.shifts);
  assert(seen.size() >= block.size());
  for (std::size_t k = 0; k < block.size(); ++k) {
    if (seen[k].fault == solver::Fault::none) {
      waiting_.add(block, k);
    } else {
      tell(block.numbers[k], Decision::rejected);
    }
  }
  if (static_cast<double>(waiting_.size()) * seconds_per_path_ > kPaths_s) finish(tell);
  block_size_.took(watch.seconds());
}

void DecisionStream::finish(const TellDecision& tell) {
  if (waiting_.size() == 0) return;
  const Stopwatch watch;
  const std::vector<solver::Verdict>& verdicts = judge_whole(waiting_.shifts);
  assert(verdicts.size() >= waiting_.size());
  for (std::size_t k = 0; k < waiting_.size(); ++k) {
    tell(waiting_.numbers[k], decision_of(verdicts[k]));
  }
  seconds_per_path_ = watch.seconds() / static_cast<double>(waiting_.size());
  waiting_.clear();
}

const std::vector<solver::Verdict>& DecisionStream::judge(const solver::ShiftBlock& block) {
  const Stopwatch watch;
  judge_whole(block);
  block_size_.took(watch.seconds());
  return verdicts_;
}

const std::vector<solver::Verdict>& DecisionStream::judge_whole(const solver::ShiftBlock& block) {
  verdicts_ = batch_.judge(block);
  const int last_but_one = model_.path().stations.back().sample - 1;
  solver::FlatVertices vertices_mm;
  for (int k = 0; k < block.sheets; ++k) {
    solver::Verdict& verdict = verdicts_[static_cast<std::size_t>(k)];
    if (verdict.deploys_from_sample < last_but_one) continue;
    model_.displace(block.of(k), vertices_mm);
    const Eigen::Matrix2Xd shifts_mm = vertices_mm - model_.base().sheet.vertices_mm;
    verdict = before_closing(model_, shifts_mm, verdict);
  }
  return verdicts_;
}

}  // namespace misalign::search
