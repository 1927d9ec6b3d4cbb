// Default angle of use, and default requirements.
#pragma once

namespace misalign::solver {

/// Default angle of use: the paper's "20 % folded".
inline constexpr double kDeployFrom_deg = 36;
/// Margins of energy, and of static friction down to kMarginTo_deg; AIAA S-114: 1 at every
/// position.
inline constexpr double kWantedMargin = 1, kMarginTo_deg = 1;
/// Buckling factor by the estimate, which lay at most 1.23 times above CalculiX on whole sheets
/// (results/buckling.md).
inline constexpr double kWantedBuckling = 1.5;
/// Share of miscut copies, or of the ways in which loose joints settle.
inline constexpr double kWantedShare = 0.95;

}  // namespace misalign::solver
