// Compares candidates' metrics of their paths with vertex coordinates, which share no code with
// them: where the first diagonal turns back, and the least rates of change.
//   vertex_metrics CANDIDATES SECONDS CAMPAIGN... The first so many candidates of each campaign,
//   as far as they are found in so much CPU time.
#include <fmt/format.h>

#include <map>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/metric_table.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "tests/bench/cpu_seconds.hpp"
#include "tests/solver/coordinate_extremes.hpp"

namespace misalign::bench {
namespace {

using solver::Metrics;

struct Column {
  const char* name;
  int compared = 0, outside = 0;
  double largest = 0;
  std::uint64_t largest_of = 0;

  void compare(std::uint64_t draw, std::optional<double> value, std::optional<double> other,
               double width_mm, double sample_deg) {
    ++compared;
    const schema::Allowance& allowance = schema::find_metric(name)->allowance;
    const bool both = value && other;
    const double off = both ? std::abs(*value - *other) : value || other ? HUGE_VAL : 0;
    const bool is_outside =
        both ? !allowance.allows(*value, *other, width_mm, sample_deg) : off > 0;
    outside += is_outside;
    if (is_outside) {
      fmt::print("  draw {}: {} {:.10g}, by vertex coordinates {:.10g}\n", draw, name,
                 value.value_or(std::nan("")), other.value_or(std::nan("")));
    }
    if (off < largest) return;
    largest = off;
    largest_of = draw;
  }
};

class Comparison {
 public:
  explicit Comparison(schema::Campaign campaign)
      : evaluator_(std::move(campaign)), mechanism_(evaluator_.mechanism()) {}

  void run(std::size_t most, double seconds) {
    constexpr std::uint64_t kAtOnce = 4096;
    const double start_s = cpu_seconds();
    std::vector<schema::Candidate> candidates;
    for (std::uint64_t lo = 0; candidates.size() < most; lo += kAtOnce) {
      if (cpu_seconds() - start_s > seconds) break;
      for (const schema::Candidate& candidate :
           work_off(evaluator_, {lo, lo + kAtOnce}).candidates) {
        if (candidates.size() < most) candidates.push_back(candidate);
      }
    }
    for (const schema::Candidate& candidate : candidates) compare(candidate);
    for (const Column& column : columns_) {
      fmt::print("{:<24} {:<30} {:>4} compared, {:>3} outside, {:.1e} at most (draw {})\n",
                 evaluator_.campaign().name, column.name, column.compared, column.outside,
                 column.largest, column.largest_of);
    }
    if (lost_ > 0)
      fmt::print("{:<24} lost by vertex coordinates: {}\n", evaluator_.campaign().name, lost_);
    std::fflush(stdout);
  }
  bool good() const {
    return std::all_of(std::begin(columns_), std::end(columns_),
                       [](const Column& column) { return column.outside == 0; });
  }

 private:
  const solver::PerforatedSheet& base() const { return evaluator_.campaign().pattern.base; }

  void compare(const schema::Candidate& candidate) {
    const double sample_deg = evaluator_.campaign().sample_deg;
    const double width_mm = mechanism_.panel_width_mm;
    const Metrics& metrics = candidate.metrics;
    const solver::FlatVertices flat_mm = base().sheet.vertices_mm + candidate.shifts_mm;
    const solver::CoordinateExtremes other =
        coordinate_extremes(base(), mechanism_, flat_mm, sample_deg, metrics.deploys_from_sample,
                            std::min(metrics.fold_limit_deg, evaluator_.campaign().end_deg));
    if (!other.is_whole) {
      ++lost_;
      fmt::print("  draw {}: lost before its fold limit at {:.10g} deg\n", candidate.draw,
                 metrics.fold_limit_deg);
      return;
    }
    const std::optional<double> values[] = {metrics.reverses_at_deg,
                                            metrics.slope_between_min_mm_per_deg,
                                            metrics.slope_min_mm_per_deg};
    const std::optional<double> others[] = {other.reverses_deg, other.least_slope_mm_per_deg,
                                            other.least_step_mm_per_deg};
    for (std::size_t k = 0; k < std::size(columns_); ++k) {
      columns_[k].compare(candidate.draw, values[k], others[k], width_mm, sample_deg);
    }
  }

  search::DrawEvaluator evaluator_;
  const solver::Mechanism& mechanism_;
  Column columns_[3] = {
      {"reverses_at_deg"}, {"slope_between_min_mm_per_deg"}, {"slope_min_mm_per_deg"}};
  int lost_ = 0;
};

}  // namespace
}  // namespace misalign::bench

int main(int count, char** arguments) {
  using namespace misalign;
  if (count < 4) {
    fmt::print(stderr, "vertex_metrics CANDIDATES SECONDS CAMPAIGN...\n");
    return 2;
  }
  bool good = true;
  for (int k = 3; k < count; ++k) {
    bench::Comparison comparison(schema::read_campaign_file(arguments[k]));
    comparison.run(std::stoul(arguments[1]), std::stod(arguments[2]));
    good = comparison.good() && good;
  }
  return good ? 0 : 1;
}
