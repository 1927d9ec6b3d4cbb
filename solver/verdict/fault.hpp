// The faults that can end the deployable range, and one table of what is said of each.
#pragma once

#include <span>
#include <string_view>

namespace misalign::solver {

/// What ends the deployable range; where several meet at a sample the first of these is reported.
/// Numbers are kept from version to version: who uses Python may have stored them.
///
/// Two are asked for by a BumpRule: before the next sample, which itself is in order, a diagonal
/// goes back by kBumpBand_widths or more. If it still goes back at that sample it has turned round
/// (reverses_between), which the next sample shows, but for the few that turn again before that; if
/// it goes on again there, no sample shows that it ever went back (bump). Of several diagonals the
/// one that goes back the most decides.
enum class Fault {
  none,                ///< deploys from the end of the path
  fold_limit,          ///< the pilot turns before the next sample
  over_folded,         ///< a crease with |rho| > 180 degrees + kOverFoldBand_deg
  assignment_flipped,  ///< a crease without its base mountain-valley sign
  not_monotone,        ///< a diagonal steps back against its direction by kStepBand_widths or more
  bump,                ///< a diagonal goes back and on again before the next sample
  soft_stop,           ///< the stop that was asked for on the way is softer than was asked for
  inactive_diagonal,   ///< D >= kInactiveFrom_deg, yet a diagonal varied by less than
                       ///< kInactiveBand_widths up to it; then D = 0
  undecided,           ///< a numerical failure (PathEnd says which): never a "no"
  reverses_between     ///< a diagonal turns back before the next sample
};

struct FaultEntry {
  /// The part that shows the fault, one crease or one diagonal: what Verdict::where numbers.
  enum class ShownBy { nothing, crease, diagonal };

  Fault fault;
  const char* name;     ///< in catalogues and JSON
  const char* label;    ///< in a legend
  const char* meaning;  ///< what happened, in words that go on from "first fault: "
  ShownBy shown_by;
};

/// Every fault once, as a legend lists them: the commonest first. Each has a colour of its name in
/// the style of the report's page.
std::span<const FaultEntry> fault_table();

const FaultEntry& entry_of(Fault fault);
inline const char* fault_name(Fault fault) { return entry_of(fault).name; }

/// Whether two stored names may be of one verdict: the same, or both of what happens between two
/// samples, for which there was one name up to version 1.0.0.
bool may_be_one_fault(std::string_view name, std::string_view other);

}  // namespace misalign::solver
