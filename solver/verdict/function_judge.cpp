#include "solver/verdict/function_judge.hpp"

#include <algorithm>
#include <cmath>

#include "solver/continuation/node_control.hpp"

namespace misalign::solver {
namespace {

// Of the band within which a diagonal is inactive, and of a limit point's angle (rad): what a
// path's close steps leave.
constexpr double kInactiveError_widths = 1e-9, kLimitError_rad = 1e-8;

}  // namespace

FunctionJudge::FunctionJudge(const Mechanism& mechanism)
    : mechanism_(mechanism),
      judge_(mechanism),
      here_(mechanism),
      again_(mechanism),
      last_(mechanism.diagonals.size()),
      last_errors_(last_),
      state_(flat_state<double>(mechanism)) {}

FunctionJudge::~FunctionJudge() = default;
FunctionJudge::FunctionJudge(const FunctionJudge&) = default;

void FunctionJudge::begin(const PathPlan& plan, const std::vector<double>& flat_lengths) {
  plan_ = &plan;
  next_ = 0;
  last_rad_ = 0;
  samples_ = 0;
  rows_.clear();
  is_sure_ = true;
  fault_known_ = false;
  last_ = flat_lengths;
  std::fill(last_errors_.begin(), last_errors_.end(), 0.0);
  judge_.begin(flat_lengths);
}

Answer FunctionJudge::see(const PathFunction& function) {
  is_sure_ = true;
  const bool turns = function.turns();
  const double end = function.end(), end_rad = function.pilot(end);
  const double end_error = turns ? function.pilot_error(end) + kLimitError_rad : 0;
  const bool clear = function.creases_are_clear();
  for (; next_ < plan_->stations.size(); ++next_) {
    const Station& station = plan_->stations[next_];
    const double pilot_rad = station.pilot_deg * kRadPerDeg;
    if (turns && std::abs(pilot_rad - end_rad) <= end_error) return unsure();
    if (pilot_rad > end_rad + (turns ? 0 : 1e-12)) return Answer::go_on;
    if (station.pilot_deg > NodeControlOptions{}.last_deg) return lost();
    if (station.sample == 0) continue;
    const double x = function.locate(pilot_rad);
    function.find_lengths(x, here_.lengths, here_.length_errors);
    bool in_order = clear;
    if (!clear) {
      const double error = function.find_creases(x, state_.creases);
      in_order = true;
      for (std::size_t k = 0; k < state_.creases.size(); ++k) {
        const HalfAngle<double>& rho = state_.creases[k];
        const double s = rho.s * mechanism_.creases[k].assignment;
        if (std::abs(rho.c - kLeastCosine) <= error || std::abs(s) <= error) {
          return unsure();
        }
        in_order = in_order && rho.c > kLeastCosine && s > 0;
      }
    }
    if (!is_decisive()) {
      know_last_better(function);
      if (!is_decisive()) return unsure();
    }
    if (!judge_.see(station, in_order ? nullptr : &state_, here_.lengths)) {
      fault_known_ = true;
      return Answer::enough;
    }
    std::swap(last_, here_.lengths);
    std::swap(last_errors_, here_.length_errors);
    last_rad_ = pilot_rad;
    rows_.insert(rows_.end(), last_.begin(), last_.end());
    ++samples_;
  }
  return Answer::go_on;
}

// The last sample again, by polynomials through nodes that came after it.
void FunctionJudge::know_last_better(const PathFunction& function) {
  if (last_rad_ == 0 || last_rad_ < function.pilot_at_oldest()) return;
  const double x = function.locate(last_rad_);
  function.find_lengths(x, again_.lengths, again_.length_errors);
  for (std::size_t d = 0; d < last_.size(); ++d) {
    if (again_.length_errors[d] >= last_errors_[d]) continue;
    last_[d] = again_.lengths[d];
    last_errors_[d] = again_.length_errors[d];
  }
  judge_.correct_last(last_);
  std::copy(last_.begin(), last_.end(), rows_.end() - static_cast<std::ptrdiff_t>(last_.size()));
}

// Whether every step is longer or shorter than the band by more than both errors, and the largest
// step back is the largest for certain.
bool FunctionJudge::is_decisive() {
  double largest = 0, second = 0, error = 0;
  for (std::size_t d = 0; d < last_.size(); ++d) {
    const double step = here_.lengths[d] - last_[d];
    const double room = here_.length_errors[d] + last_errors_[d];
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
  return judge_.conclude(path);
}

}  // namespace misalign::solver
