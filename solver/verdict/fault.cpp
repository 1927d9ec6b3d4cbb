#include "solver/verdict/fault.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::solver {
namespace {

using ShownBy = FaultEntry::ShownBy;

constexpr FaultEntry kFaults[] = {
    {Fault::not_monotone, "not_monotone", "diagonal reverses",
     "a diagonal reverses: it stops growing or shrinking and goes back", ShownBy::diagonal},
    {Fault::fold_limit, "fold_limit", "fold limit",
     "the pilot crease reaches its fold limit: no flatter or deeper state follows",
     ShownBy::nothing},
    {Fault::over_folded, "over_folded", "over-folded",
     "a crease is folded beyond 180°: two panels would pass through each other", ShownBy::crease},
    {Fault::assignment_flipped, "assignment_flipped", "assignment flipped",
     "a crease changes from mountain to valley or back", ShownBy::crease},
    {Fault::inactive_diagonal, "inactive_diagonal", "inactive diagonal",
     "a diagonal does not change its length: it drives nothing", ShownBy::diagonal},
    {Fault::reverses_between, "reverses_between_samples", "reverses between samples",
     "a diagonal turns back between two samples, and still goes back at the next",
     ShownBy::diagonal},
    {Fault::bump, "bump_between_samples", "bump between samples",
     "a diagonal goes back and on again between two samples", ShownBy::diagonal},
    {Fault::soft_stop, "soft_stop", "soft stop",
     "the stop on the way is softer than the campaign asks for", ShownBy::nothing},
    {Fault::energy_rises, "energy_rises", "energy rises",
     "the total energy of the filling rises on the way to flat", ShownBy::diagonal},
    {Fault::weak_drive, "weak_drive", "weak drive",
     "the filling drives the sheet more weakly than the campaign asks for", ShownBy::nothing},
    {Fault::off_shape, "off_shape", "off the shape",
     "the folded sheet lies farther from the target than the campaign allows", ShownBy::nothing},
    {Fault::undecided, "undecided", "undecided", "numerical failure: neither accepted nor rejected",
     ShownBy::nothing},
    {Fault::none, "none", "no fault", "no fault up to the end of the path", ShownBy::nothing},
};

}  // namespace

std::span<const FaultEntry> fault_table() { return kFaults; }

const FaultEntry& entry_of(Fault fault) {
  const auto at = std::ranges::find(kFaults, fault, &FaultEntry::fault);
  assert(at != std::end(kFaults));
  return *at;
}

bool may_be_one_fault(std::string_view name, std::string_view other) {
  const auto is_between = [](std::string_view fault) {
    return fault == fault_name(Fault::reverses_between) || fault == fault_name(Fault::bump);
  };
  return name == other || (is_between(name) && is_between(other));
}

}  // namespace misalign::solver
