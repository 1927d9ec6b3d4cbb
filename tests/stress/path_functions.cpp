// Errors of paths as functions, of lengths and of their rates, beside the bounds that they claim:
// at angles drawn at random, against states that are solved there by dense matrices.
//   path_functions SHEETS CAMPAIGN...
#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "schema/campaign/campaign_file.hpp"
#include "solver/continuation/path_follower.hpp"
#include "solver/judging/function_bumps.hpp"
#include "solver/linear/newton.hpp"
#include "solver/model/model.hpp"
#include "solver/model/pivoted_state.hpp"

namespace misalign {
namespace {

constexpr int kAngles = 50;

class Errors {
 public:
  Errors(const schema::Campaign& campaign, unsigned seed)
      : campaign_(campaign),
        model_(campaign.pattern.base, campaign.path()),
        follower_(model_.mechanism(), model_.elimination()),
        solver_(model_.mechanism()),
        bumps_(model_.mechanism()),
        estimate_(model_.mechanism()),
        near_(solver::flat_state<double>(model_.mechanism())),
        solved_(model_.mechanism()),
        rates_(estimate_.lengths.size()),
        words_(seed) {}

  void run(int sheets) {
    for (int i = 0; i < sheets; ++i) {
      solver::FlatVertices vertices_mm = campaign_.pattern.base.sheet.vertices_mm;
      for (const int v : campaign_.misalignment.vertices) {
        for (int k = 0; k < 2; ++k) vertices_mm(k, v) += shift_mm();
      }
      place(model_.mechanism(), vertices_mm, geometry_);
      solver::flat_lengths(model_.mechanism(), geometry_, rates_.data());
      bumps_.begin(rates_);
      angles_deg_.clear();
      for (int k = 0; k < kAngles; ++k) angles_deg_.push_back(campaign_.end_deg * share());
      std::sort(angles_deg_.begin(), angles_deg_.end());
      next_ = 0;
      follower_.follow({&geometry_, &model_.path().start, &model_.path()}, *this);
      ++sheets_;
    }
  }

  // For the follower.
  solver::ObserverResult see(const solver::PathFunction& function, int lane) {
    const double end_rad = function.pilot(function.end());
    if (bumps_.can_look(function)) bumps_.begin_segment(function);
    for (; next_ < angles_deg_.size(); ++next_) {
      const double pilot_rad = angles_deg_[next_] * solver::kRadPerDeg;
      if (pilot_rad > end_rad) break;
      if (angles_deg_[next_] < model_.path().stations.front().pilot_deg) continue;
      compare(function, pilot_rad, lane);
    }
    return solver::ObserverResult::go_on;
  }
  void ended(const solver::PathResult& path, int) {
    iterations_ += path.newton_iterations;
    lost_ += path.lost();
  }

  bool print() const {
    fmt::print(
        "{:<22} {:>7} sheets {:>8} angles: error {:.1e} at most, "
        "bound {:.1e}; error / bound {:.2f} at most, {} above, "
        "{} not solved; rates: error {:.1e} at most, error / bound {:.2f} at most, {} above; "
        "{:.1f} iterations a path, {:.2f} % left for close steps\n",
        campaign_.name, sheets_, compared_, largest_error_, largest_bound_, largest_share_, above_,
        unsolved_, largest_rate_error_, largest_rate_share_, rates_above_,
        1.0 * iterations_ / sheets_, 100.0 * lost_ / sheets_);
    return above_ + rates_above_ == 0;
  }

 private:
  double share() { return static_cast<double>(words_()) / 4294967296.0; }
  double shift_mm() {
    const double level = campaign_.misalignment.distribution == schema::ShiftDistribution::ternary
                             ? static_cast<int>(words_() % 3) - 1
                             : 2 * share() - 1;
    return level * campaign_.misalignment.amplitude_mm;
  }

  void compare(const solver::PathFunction& function, double pilot_rad, int lane) {
    const double x = function.locate(pilot_rad);
    function.look(x, estimate_);
    follower_.find_state({x, &near_}, lane);
    near_.creases[model_.mechanism().pilot] =
        solver::half_angle_of_deg(pilot_rad / solver::kRadPerDeg);
    solver_.find(geometry_, near_, solved_);
    if (!(solver_.open_by() <= solver::Newton::Options{}.closure_tolerance)) {
      ++unsolved_;
      return;
    }
    ++compared_;
    for (std::size_t d = 0; d < rates_.size(); ++d) {
      const double error = std::abs(solved_.lengths[d] - estimate_.lengths[d]);
      largest_error_ = std::max(largest_error_, error);
      largest_bound_ = std::max(largest_bound_, estimate_.length_errors[d]);
      largest_share_ = std::max(largest_share_, error / estimate_.length_errors[d]);
      above_ += error > estimate_.length_errors[d];
    }
    if (bumps_.can_look(function)) compare_rates(function, x);
  }

  // By the function's variable. What nodes are off by shows over the length of a segment.
  void compare_rates(const solver::PathFunction& function, double x) {
    const double bound =
        bumps_.look(x, rates_) + 8 * function.node_error() / (function.to() - function.from());
    const double pilot_slope = function.pilot_slope(x);
    for (std::size_t d = 0; d < rates_.size(); ++d) {
      const double error = std::abs(solved_.slopes[d] * pilot_slope - rates_[d]);
      largest_rate_error_ = std::max(largest_rate_error_, error);
      largest_rate_share_ = std::max(largest_rate_share_, error / bound);
      rates_above_ += error > bound;
    }
  }

  const schema::Campaign& campaign_;
  const solver::Model model_;
  solver::PathFollower<double, solver::LongSteps> follower_;
  solver::PivotedState solver_;
  solver::FunctionBumps bumps_;
  solver::PathFunction::Estimate estimate_;
  solver::FoldState<double> near_;
  solver::PathPoint solved_;
  std::vector<double> rates_;
  std::mt19937 words_;
  solver::SheetGeometry<double> geometry_;
  std::vector<double> angles_deg_;
  std::size_t next_ = 0;
  int sheets_ = 0, compared_ = 0, above_ = 0, unsolved_ = 0, iterations_ = 0, lost_ = 0;
  int rates_above_ = 0;
  double largest_rate_error_ = 0, largest_rate_share_ = 0;
  double largest_error_ = 0, largest_bound_ = 0, largest_share_ = 0;
};

}  // namespace
}  // namespace misalign

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "path_functions SHEETS CAMPAIGN...\n");
    return 2;
  }
  bool good = true;
  for (int k = 2; k < argc; ++k) {
    const misalign::schema::Campaign campaign = misalign::schema::read_campaign_file(argv[k]);
    misalign::Errors errors(campaign, 1);
    errors.run(std::stoi(argv[1]));
    good = errors.print() && good;
  }
  return good ? 0 : 1;
}
