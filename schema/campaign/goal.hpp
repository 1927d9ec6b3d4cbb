// Defines a campaign's goal (numbers of draws and candidates, precision of the rate) and the draw
// at which it ends.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "schema/campaign/draw_range.hpp"

namespace misalign::schema {

/// A goal that depends on results of draws ends at a multiple of this number of draws.
inline constexpr std::uint64_t kGoalGranule = 4096;
/// A goal that depends on results of populations ends at a multiple of this number of them, as an
/// interval needs that many. results/splitting/stopping.md has the effect on rate and interval.
inline constexpr std::size_t kGoalPopulations = 20;

/// Goal of a run; draws count from the range's start.
struct Goal {
  DrawRange range{0, kEndOfDraws};
  std::optional<std::uint64_t> draws, accepted;
  /// Half the width of the acceptance rate's 95 % interval, over the rate.
  std::optional<double> relative_error{};
  /// true in a splitting search: the range is one of populations' numbers, and accepted draws are
  /// not counted.
  bool of_populations = false;

  /// Returns the goal's end unless results end it before.
  std::uint64_t planned_end() const;
  /// Returns whether results can end the goal.
  bool looks_at_results() const { return relative_error || (accepted && !of_populations); }
  friend bool operator==(const Goal&, const Goal&) = default;
};

/// Finds the goal's end from the finished draws: the first multiple of kGoalGranule draws from the
/// range's start at which no earlier draw is missing and the goal is reached. It is a function of
/// the results alone, in any order.
class GoalEnd {
 public:
  explicit GoalEnd(const Goal& goal);

  /// Adds a range of finished draws that was not added before; accepted and undecided draws
  /// ascending.
  void add(const DrawRange& done, const std::vector<std::uint64_t>& accepted,
           const std::vector<std::uint64_t>& undecided);
  /// Adds a finished population with its estimate of the acceptance rate.
  void add_population(const DrawRange& numbers, double share);
  std::uint64_t value() const { return end_; }

 private:
  struct Part {
    std::uint64_t hi;
    std::vector<std::uint64_t> accepted, undecided;
    double share = 0;
  };
  void add(std::uint64_t lo, Part part);
  void follow(const Part& part);
  void follow_population(const Part& part);
  void close_granule();
  bool known_well_enough(std::uint64_t draws) const;

  Goal goal_;
  std::uint64_t end_;
  bool met_ = false;
  std::uint64_t reached_;                // below this no draw is missing
  std::map<std::uint64_t, Part> ahead_;  // lo -> part behind a gap
  std::uint64_t granule_ = 0;            // the granule being counted
  std::uint64_t accepted_ = 0, undecided_ = 0;
  std::vector<double> shares_;  // estimates of the populations
  bool accepted_more_ = false;  // since the last closed granule
};

}  // namespace misalign::schema
