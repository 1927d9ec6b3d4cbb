#include "schema/campaign/goal.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "schema/campaign/share_interval.hpp"
#include "schema/campaign/split_rate.hpp"

namespace misalign::schema {

std::uint64_t Goal::planned_end() const {
  if (!draws || *draws >= range.size()) return range.hi;
  return range.lo + *draws;
}

GoalEnd::GoalEnd(const Goal& goal)
    : goal_(goal), end_(goal.planned_end()), reached_(goal.range.lo) {
  if (goal.accepted == 0 && !goal.of_populations) {  // reached before the first draw
    met_ = true;
    end_ = goal.range.lo;
  }
}

void GoalEnd::add(const DrawRange& done, const std::vector<std::uint64_t>& accepted,
                  const std::vector<std::uint64_t>& undecided) {
  add(done.lo, {done.hi, accepted, undecided});
}

void GoalEnd::add_population(const DrawRange& numbers, double share) {
  add(numbers.lo, {numbers.hi, {}, {}, share});
}

void GoalEnd::add(std::uint64_t lo, Part part) {
  if (met_ || !goal_.looks_at_results() || part.hi <= reached_) return;
  ahead_.emplace(lo, std::move(part));
  while (!met_ && !ahead_.empty() && ahead_.begin()->first <= reached_) {
    const Part next = ahead_.extract(ahead_.begin()).mapped();
    goal_.of_populations ? follow_population(next) : follow(next);
  }
  if (met_) ahead_.clear();
}

void GoalEnd::follow_population(const Part& part) {
  reached_ = part.hi;
  shares_.push_back(part.share);
  if (shares_.size() % kGoalPopulations != 0) return;
  const SplitRate rate = split_rate(shares_);
  met_ = has_converged(rate) && *rate.relative_half_width() <= *goal_.relative_error;
  if (met_) end_ = std::min(end_, part.hi);
}

// Counts the accepted draws of the next part of the prefix, and closes granules.
void GoalEnd::follow(const Part& part) {
  const auto granule_of = [&](std::uint64_t draw) {
    return (draw - goal_.range.lo) / kGoalGranule;
  };
  assert(std::ranges::is_sorted(part.accepted) && std::ranges::is_sorted(part.undecided));
  auto next_undecided = std::lower_bound(part.undecided.begin(), part.undecided.end(), reached_);
  const auto close_up_to = [&](std::uint64_t granule) {
    if (granule == granule_) return;
    const std::uint64_t closed_to = goal_.range.lo + (granule_ + 1) * kGoalGranule;
    for (; next_undecided != part.undecided.end() && *next_undecided < closed_to;
         ++next_undecided) {
      ++undecided_;
    }
    close_granule();
    granule_ = granule;
  };
  const auto first = std::lower_bound(part.accepted.begin(), part.accepted.end(), reached_);
  for (auto draw = first; draw != part.accepted.end() && !met_; ++draw) {
    close_up_to(granule_of(*draw));
    ++accepted_;
    accepted_more_ = true;
  }
  reached_ = part.hi;
  if (!met_) close_up_to(granule_of(reached_));
  undecided_ += static_cast<std::uint64_t>(part.undecided.end() - next_undecided);
}

// Granules without an accepted draw are skipped: the count stays, and the interval of the rate,
// relative to the rate, only widens.
void GoalEnd::close_granule() {
  if (!accepted_more_) return;
  accepted_more_ = false;
  const std::uint64_t draws = (granule_ + 1) * kGoalGranule;
  if ((goal_.accepted && accepted_ >= *goal_.accepted) ||
      (goal_.relative_error && known_well_enough(draws))) {
    met_ = true;
    end_ = std::min(end_, goal_.range.lo + draws);
  }
}

bool GoalEnd::known_well_enough(std::uint64_t draws) const {
  const ShareInterval rate = share_interval(accepted_, undecided_, draws);
  const double width = rate.high - rate.low;
  return width * static_cast<double>(draws) <=
         2 * *goal_.relative_error * static_cast<double>(accepted_);
}

}  // namespace misalign::schema
