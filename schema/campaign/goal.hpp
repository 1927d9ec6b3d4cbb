// A campaign's goal (how many draws, how many accepted, how precise a rate), and the draw at which
// it ends.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "schema/campaign/draw_range.hpp"

namespace misalign::schema {

/// A goal that depends on what the draws give ends at a multiple of this many draws.
inline constexpr std::uint64_t kGoalGranule = 4096;
/// And one that depends on what populations give at a multiple of this many of them, as many as an
/// interval needs. What stopping there does to rate and interval: results/splitting/stopping.md.
inline constexpr std::size_t kGoalPopulations = 20;

/// What a run wants; draws count from the range's start.
struct Goal {
  DrawRange range{0, kEndOfDraws};
  std::optional<std::uint64_t> draws, accepted;
  /// Half the width of the acceptance rate's 95 % interval, over the rate.
  std::optional<double> relative_error{};
  /// Of a splitting search: the range is one of populations' numbers, and no accepted draws are
  /// counted.
  bool of_populations = false;

  /// Where the goal ends if the results do not end it before.
  std::uint64_t planned_end() const;
  /// Whether the results can end it.
  bool looks_at_results() const { return relative_error || (accepted && !of_populations); }
  friend bool operator==(const Goal&, const Goal&) = default;
};

/// Where a goal ends, as far as the draws done say: at the first multiple of kGoalGranule draws
/// from the range's start below which no draw is missing, as many are accepted as were wanted, or
/// the acceptance rate is known as well as was wanted. A function of the results alone: the order
/// in which they come does not matter.
class GoalEnd {
 public:
  explicit GoalEnd(const Goal& goal);

  /// A range of draws that is done, none of it done before; accepted and undecided draws ascending.
  void add(const DrawRange& done, const std::vector<std::uint64_t>& accepted,
           const std::vector<std::uint64_t>& undecided);
  /// The same of one population, whose estimate of the acceptance rate this is.
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
  std::map<std::uint64_t, Part> ahead_;  // lo -> what lies behind a gap
  std::uint64_t granule_ = 0;            // the one that is being counted
  std::uint64_t accepted_ = 0, undecided_ = 0;
  std::vector<double> shares_;  // of populations
  bool accepted_more_ = false;  // since a granule was last closed
};

}  // namespace misalign::schema
