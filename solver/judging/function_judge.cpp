#include "solver/judging/function_judge.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/continuation/long_steps.hpp"
#include "solver/judging/extreme_finder.hpp"

namespace misalign::solver {
namespace {

// Errors that close steps leave in the variation of an inactive diagonal, and in a limit point's
// angle (rad).
constexpr double kInactiveError_widths = 1e-9, kLimitError_rad = 1e-8;

// Relative error bound of a stop's stiffness: in 16,000 stops of 4 x 4 and 6 x 6 sheets errors were
// below 1e-3, and above 1e-4 in eleven, most next to the path's end.
constexpr double kStiffnessError = 0.05;

// Relative error bound of the slopes' norm, half of the stiffness's.
constexpr double kSlopesError = kStiffnessError / 2;

}  // namespace

FunctionJudge::FunctionJudge(const Mechanism& mechanism, const Criterion& criterion)
    : mechanism_(mechanism),
      criterion_(criterion),
      judge_(mechanism, criterion),
      estimate_(mechanism),
      again_(mechanism),
      last_(mechanism.diagonals.size()),
      last_errors_(last_),
      before_last_errors_(last_),
      state_(flat_state<double>(mechanism)) {
  if (criterion.bumps == BumpRule::exact) bumps_.emplace(mechanism);
}

FunctionJudge::~FunctionJudge() = default;
FunctionJudge::FunctionJudge(const FunctionJudge&) = default;

void FunctionJudge::begin(const PathPlan& plan, const std::vector<double>& flat_lengths,
                          const SheetGeometry<double>* geometry) {
  assert(flat_lengths.size() == last_.size());
  plan_ = &plan;
  next_ = 0;
  last_rad_ = 0;
  samples_ = 0;
  limit_error_rad_ = 0;
  rows_.clear();
  is_sure_ = true;
  fault_known_ = false;
  last_ = flat_lengths;
  std::fill(last_errors_.begin(), last_errors_.end(), 0.0);
  std::fill(before_last_errors_.begin(), before_last_errors_.end(), 0.0);
  judge_.begin(flat_lengths, geometry);
  if (bumps_) bumps_->begin(flat_lengths);
}

ObserverResult FunctionJudge::see(const PathFunction& function) {
  assert(plan_ && !fault_known_);  // begun, and no segment follows a fault
  is_sure_ = true;
  const bool turns = function.turns();
  const double end = function.end(), end_rad = function.pilot(end);
  const double end_error = turns ? function.pilot_error(end) + kLimitError_rad : 0;
  limit_error_rad_ = end_error;
  const bool clear = function.creases_are_clear();
  if (bumps_) {
    is_sure_ = FunctionBumps::can_look(function);  // otherwise the next segment includes this one
    if (!is_sure_) return turns ? ObserverResult::lost : ObserverResult::go_on;
    bumps_->begin_segment(function);
  }
  for (; next_ < plan_->stations.size(); ++next_) {
    const Station& station = plan_->stations[next_];
    const double pilot_rad = station.pilot_deg * kRadPerDeg;
    if (turns && std::abs(pilot_rad - end_rad) <= end_error) return unsure();
    if (pilot_rad > end_rad + (turns ? 0 : 1e-12)) break;
    if (station.pilot_deg > LongSteps::Options{}.last_deg) return lost();
    if (station.sample == 0) continue;
    const double x = function.locate(pilot_rad);
    function.find_lengths(x, estimate_.lengths, estimate_.length_errors);
    const std::optional<bool> in_order = clear ? true : find_creases(x, function);
    if (!in_order) return unsure();
    const ObserverResult answer = see_sample(station, x, *in_order, function);
    if (answer != ObserverResult::go_on) return answer;
    std::swap(last_, estimate_.lengths);
    std::swap(before_last_errors_, last_errors_);
    std::swap(last_errors_, estimate_.length_errors);
    last_rad_ = pilot_rad;
    rows_.insert(rows_.end(), last_.begin(), last_.end());
    ++samples_;
  }
  const bool goes_on = !turns && next_ < plan_->stations.size();
  if (bumps_ && goes_on &&
      bumps_->look_at_end(judge_, function) == FunctionBumps::Heading::unsure) {
    return unsure();
  }
  return ObserverResult::go_on;
}

// Returns whether the creases are in order, if that is certain.
std::optional<bool> FunctionJudge::find_creases(double x, const PathFunction& function) {
  const double error = function.find_creases(x, state_.creases);
  bool in_order = true;
  for (std::size_t k = 0; k < state_.creases.size(); ++k) {
    const HalfAngle<double>& rho = state_.creases[k];
    const double s = rho.s * mechanism_.creases[k].assignment;
    if (std::abs(rho.c - kLeastCosine) <= error || std::abs(s) <= error) return std::nullopt;
    in_order = in_order && rho.c > kLeastCosine && s > 0;
  }
  return in_order;
}

// Judges the sample at point `x` of the segment, and the interval before it.
ObserverResult FunctionJudge::see_sample(const Station& station, double x, bool creases_in_order,
                                         const PathFunction& function) {
  if (!is_decisive()) {
    know_last_better(function);
    if (!is_decisive()) return unsure();
  }
  fault_known_ = !judge_.is_in_order(creases_in_order ? nullptr : &state_, estimate_.lengths,
                                     &estimate_.length_errors);
  if (fault_known_ && !score_is_certain(x, function)) {
    judge_.reconsider();
    fault_known_ = false;
    return unsure();
  }
  if (fault_known_) return ObserverResult::enough;
  if (bumps_) {
    const FunctionBumps::Heading heading = bumps_->look_at_sample(x, judge_, function);
    if (heading == FunctionBumps::Heading::unsure) return unsure();
    if (heading == FunctionBumps::Heading::back) {
      const std::optional<double> rate = bumps_->rate_there(x);
      if (!rate) return unsure();
      const std::optional<double> from_deg = find_where_goes_back(station, *rate, function);
      if (!from_deg) return lost();
      fault_known_ = true;
      judge_.end_between(bumps_->where(), *rate, *from_deg);
      return ObserverResult::enough;
    }
    bumps_->take(station.pilot_deg * kRadPerDeg);
  }
  if (station.sample == criterion_.stop_sample) {
    const std::optional<bool> is_stiff = find_stop_stiff(x, function);
    if (!is_stiff) return unsure();
    fault_known_ = !*is_stiff;
    if (fault_known_) {
      judge_.end(Fault::soft_stop, -1, criterion_.stop_part(again_.slopes));
      return ObserverResult::enough;
    }
  }
  if (judge_.energy() && station.sample <= judge_.energy()->from_sample()) {
    const ObserverResult driven = see_drive(station, x, function);
    if (driven != ObserverResult::go_on) return driven;
  }
  judge_.take(station, estimate_.lengths);
  return ObserverResult::go_on;
}

// Collects what the margins of the energy criterion need, and judges them at the threshold.
ObserverResult FunctionJudge::see_drive(const Station& station, double x,
                                        const PathFunction& function) {
  EnergyJudge& energy = *judge_.energy();
  if (energy.asks_for_turning()) {
    const double error = function.find_creases(x, state_.creases);
    energy.set_creases(state_.creases, error);
  }
  if (energy.asks_for_moment() && station.pilot_deg >= kInactiveFrom_deg) {
    function.look(x, again_);
    energy.set_slopes(again_.slopes, kSlopesError);
  }
  if (station.sample < energy.from_sample()) return ObserverResult::go_on;
  const DriveRatio drive = energy.drive();
  const std::optional<bool> is_met = drive.is_met();
  if (!is_met) return unsure();
  if (*is_met) return ObserverResult::go_on;
  if (criterion_.scores && !drive.has_certain_score()) return unsure();
  fault_known_ = true;
  judge_.end(Fault::weak_drive, -1, drive.value);
  return ObserverResult::enough;
}

// Returns whether the part by which the sample missed determines the score, if one is requested.
bool FunctionJudge::score_is_certain(double x, const PathFunction& function) {
  if (!criterion_.scores) return true;
  const bool by_crease =
      judge_.fault() == Fault::over_folded || judge_.fault() == Fault::assignment_flipped;
  const double crease_error = by_crease ? function.find_creases(x, state_.creases) : 0;
  for (std::size_t d = 0; d < last_.size(); ++d) {
    again_.length_errors[d] =
        last_errors_[d] + std::max(before_last_errors_[d], estimate_.length_errors[d]);
  }
  return judge_.missed_part(&state_, estimate_.lengths, &again_.length_errors, crease_error)
      .is_certain();
}

// Returns the angle before this sample, at which the diagonal's rate is `rate`, where it begins to
// go back, if that determines the score; 0 if no score is requested. None for a bump, whose rate at
// the sample does not show how fast it turns.
std::optional<double> FunctionJudge::find_where_goes_back(const Station& station, double rate,
                                                          const PathFunction& function) {
  if (!criterion_.scores || samples_ == 0) return 0;
  const int d = bumps_->where();
  if (!judge_.goes_back(d, rate) || last_rad_ < function.pilot_at_oldest()) return std::nullopt;
  const double last_deg = last_rad_ / kRadPerDeg;
  const double from_deg =
      goes_back_from_deg(function, d, judge_.direction(d), last_deg, station.pilot_deg);
  // The rate falls to `rate` over at most the whole step, at half its mean slope or faster.
  const double x = function.locate(from_deg * kRadPerDeg);
  const double rate_error = bumps_->look(x, again_.slopes) + function.node_error();
  const double step_rad = station.pilot_deg * kRadPerDeg - last_rad_;
  const double error_rad = 2 * rate_error / std::abs(rate) * step_rad + function.pilot_error(x);
  return judge_.part_at(from_deg, error_rad).is_certain() ? std::optional(from_deg) : std::nullopt;
}

// Returns whether the stop is stiff enough, if that is certain.
std::optional<bool> FunctionJudge::find_stop_stiff(double x, const PathFunction& function) {
  function.look(x, again_);
  const double part = criterion_.stop_part(again_.slopes);
  if (std::abs(part - 1) <= kStiffnessError) return std::nullopt;
  LeastPart missed;
  missed.add(part, kStiffnessError);
  if (criterion_.scores && part < 1 && !missed.is_certain()) return std::nullopt;
  return part > 1;
}

// Improves the last sample by polynomials through later nodes.
void FunctionJudge::know_last_better(const PathFunction& function) {
  if (last_rad_ == 0 || last_rad_ < function.pilot_at_oldest()) return;
  const double x = function.locate(last_rad_);
  function.find_lengths(x, again_.lengths, again_.length_errors);
  for (std::size_t d = 0; d < last_.size(); ++d) {
    if (again_.length_errors[d] >= last_errors_[d]) continue;
    last_[d] = again_.lengths[d];
    last_errors_[d] = again_.length_errors[d];
  }
  assert(rows_.size() >= last_.size());
  judge_.correct_last(last_, &last_errors_);
  std::copy(last_.begin(), last_.end(), rows_.end() - static_cast<std::ptrdiff_t>(last_.size()));
}

// Returns whether every step differs from the band by more than both errors, and the largest step
// back is certain.
bool FunctionJudge::is_decisive() {
  if (EnergyJudge* const energy = judge_.energy()) {
    energy->look(estimate_.lengths, &estimate_.length_errors);
    return energy->is_decisive();
  }
  double largest = 0, second = 0, error = 0;
  for (std::size_t d = 0; d < last_.size(); ++d) {
    const double step = estimate_.lengths[d] - last_[d];
    const double room = estimate_.length_errors[d] + last_errors_[d];
    if (std::abs(std::abs(step) - kStepBand_widths) <= room) return false;
    if (std::abs(step) < kStepBand_widths) continue;
    if (!judge_.goes_back(static_cast<int>(d), step)) continue;
    error = std::max(error, room);
    if (std::abs(step) > largest) {
      second = largest;
      largest = std::abs(step);
    } else {
      second = std::max(second, std::abs(step));
    }
  }
  return largest == 0 || largest - second > 2 * error;
}

std::optional<Verdict> FunctionJudge::conclude(const PathResult& path) const {
  if (!is_sure_ || (path.lost() && !fault_known_)) return std::nullopt;
  if (std::abs(judge_.least_span() - kInactiveBand_widths) <= kInactiveError_widths) {
    return std::nullopt;
  }
  if (criterion_.scores && judge_.fault() == Fault::none &&
      !judge_.limit_part(path, limit_error_rad_).is_certain()) {
    return std::nullopt;
  }
  return judge_.conclude(path);
}

}  // namespace misalign::solver
