#include "solver/play/backlash.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "solver/continuation/path.hpp"

namespace misalign::solver {
namespace {

// Values of the trials that have one, in order.
template <class Value>
std::vector<double> sorted(const std::vector<BacklashTrial>& trials, Value value_of) {
  std::vector<double> values;
  for (const BacklashTrial& trial : trials) {
    if (const std::optional<double> value = value_of(trial)) values.push_back(*value);
  }
  std::sort(values.begin(), values.end());
  return values;
}

std::vector<double> known(const std::vector<BacklashTrial>& trials, double BacklashTrial::*angle) {
  return sorted(trials, [angle](const BacklashTrial& trial) {
    return trial.is_known ? std::optional(trial.*angle) : std::nullopt;
  });
}

}  // namespace

const char* name_of(BacklashTrial::BranchEnd end) {
  switch (end) {
    case BacklashTrial::BranchEnd::flat:
      return "flat";
    case BacklashTrial::BranchEnd::turns:
      return "turns";
    case BacklashTrial::BranchEnd::other_branch:
      return "other_branch";
    default:
      return "not_known";
  }
}

std::uint64_t Backlash::undecided() const {
  return static_cast<std::uint64_t>(std::count_if(
      trials.begin(), trials.end(), [](const BacklashTrial& trial) { return !trial.is_known; }));
}

std::uint64_t Backlash::one_way_to(double pilot_deg) const {
  return static_cast<std::uint64_t>(
      std::count_if(trials.begin(), trials.end(), [&](const BacklashTrial& trial) {
        return trial.is_known && trial.one_way_from_deg <= from_deg + kSameAngle_deg &&
               trial.one_way_to_deg >= pilot_deg - kSameAngle_deg;
      }));
}

std::vector<double> Backlash::lost_deg() const {
  return sorted(trials, [](const BacklashTrial& trial) {
    return trial.lost == BacklashTrial::BranchEnd::not_known ? std::nullopt
                                                             : std::optional(trial.lost_deg);
  });
}

std::vector<double> Backlash::one_way_from_deg() const {
  return known(trials, &BacklashTrial::one_way_from_deg);
}

std::vector<double> Backlash::one_way_to_deg() const {
  return known(trials, &BacklashTrial::one_way_to_deg);
}

std::vector<double> Backlash::stops_deg() const {
  return sorted(trials, [](const BacklashTrial& trial) {
    return trial.stop_deg > 0 ? trial.stop_deg : std::nullopt;
  });
}

std::vector<double> Backlash::left_over() const {
  assert(backlash_mm > 0);
  return sorted(trials, [this](const BacklashTrial& trial) {
    return std::optional(trial.gap_widths * panel_width_mm / backlash_mm);
  });
}

}  // namespace misalign::solver
