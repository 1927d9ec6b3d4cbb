// What is asked of a sheet, and from where it is let go, where nothing is said.
#pragma once

namespace misalign::solver {

/// Where a sheet is let go: the paper's "20 % folded".
inline constexpr double kDeployFrom_deg = 36;
/// Of energy, and of the static margin down to this angle; AIAA S-114: 1 at every position.
inline constexpr double kWantedMargin = 1, kMarginTo_deg = 1;
/// Of miscut copies, or of the ways in which loose joints settle.
inline constexpr double kWantedShare = 0.95;

}  // namespace misalign::solver
