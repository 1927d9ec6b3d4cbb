// What can end the deployable range, and one table of what is said of it.
#pragma once

#include <span>

namespace misalign::solver {

/// What ends the deployable range; where several meet at a sample the first of these is reported.
enum class Fault {
  none,                ///< deploys from the end of the path
  fold_limit,          ///< the pilot turns before the next sample
  over_folded,         ///< a crease with |rho| > 180 degrees + kOverFoldBand_deg
  assignment_flipped,  ///< a crease without its base mountain-valley sign
  not_monotone,        ///< a diagonal steps back against its direction by kStepBand_widths or more
  bump,                ///< it goes back before the next sample by kBumpBand_widths or more, where
                       ///< that was asked for
  soft_stop,           ///< the stop that was asked for on the way is softer than was asked for
  inactive_diagonal,   ///< D >= kInactiveFrom_deg, yet a diagonal varied by less than
                       ///< kInactiveBand_widths up to it; then D = 0
  undecided            ///< a numerical failure (PathEnd says which): never a "no"
};

/// Whether one crease or one diagonal shows it: what Verdict::where numbers.
enum class ShownBy { nothing, crease, diagonal };

struct FaultEntry {
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

}  // namespace misalign::solver
