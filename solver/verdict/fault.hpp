// Lists the faults that can end the deployable range, with one table of their names and meanings.
#pragma once

#include <span>
#include <string_view>

namespace misalign::solver {

/// A fault that ends the deployable range; of several at one sample the first in this list is
/// reported. Numbers are kept between versions, since users of Python may have stored them.
///
/// Two depend on a BumpRule: a diagonal goes back by kBumpBand_widths or more before the next
/// sample, which itself is in order. If it still goes back at that sample it has reversed
/// (reverses_between), which the sample after shows unless it turns again before; if it goes on
/// there, no sample shows the retreat (bump). Of several diagonals that with the largest retreat
/// decides.
enum class Fault {
  none,                ///< deploys from the end of the path
  fold_limit,          ///< the pilot turns before the next sample
  over_folded,         ///< a crease with |rho| > 180 degrees + kOverFoldBand_deg
  assignment_flipped,  ///< a crease without its base mountain-valley sign
  not_monotone,        ///< a diagonal steps back against its direction by kStepBand_widths or more
  bump,                ///< a diagonal goes back and on again before the next sample
  soft_stop,           ///< the stop is softer than the criterion demands
  inactive_diagonal,   ///< D >= kInactiveFrom_deg, yet a diagonal varied by less than
                       ///< kInactiveBand_widths up to it; then D = 0
  undecided,           ///< a numerical failure (PathEnd says which): never a "no"
  reverses_between,    ///< a diagonal turns back before the next sample
  energy_rises,        ///< the filling's energy does not fall from this sample towards flat
  weak_drive,          ///< a margin of the energy criterion is missed at this sample
  off_shape            ///< the sheet lies too far from a target, which it should have there
};

struct FaultEntry {
  /// The kind of part that shows the fault, numbered by Verdict::where.
  enum class ShownBy { nothing, crease, diagonal };

  Fault fault;
  const char* name;     ///< name in catalogues and JSON
  const char* label;    ///< label in legends
  const char* meaning;  ///< description that follows "first fault: "
  ShownBy shown_by;
};

/// Every fault in the order of a legend, the commonest first. The report page's style names a
/// colour for each.
std::span<const FaultEntry> fault_table();

const FaultEntry& entry_of(Fault fault);
inline const char* fault_name(Fault fault) { return entry_of(fault).name; }

/// Returns whether two stored names may belong to one verdict: if equal, or if both happen between
/// samples, which had one name up to version 1.0.0.
bool may_be_one_fault(std::string_view name, std::string_view other);

}  // namespace misalign::solver
