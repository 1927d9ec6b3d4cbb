// Energy that springs or wires on the diagonals of the holes store along the path, and the moment
// with which they drive the sheet back to flat (Saito, Tsukahara & Okabe 2016, sections 5 and 6).
#pragma once

#include <optional>
#include <vector>

#include "solver/motion/actuators.hpp"
#include "solver/motion/few_diagonals.hpp"
#include "solver/records/metrics.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

/// The share of its least moment that the smallest set of diagonals must keep.
inline constexpr double kShareOfFew = 0.5;

/// Forces, energies and moments of a filling along a path. Row 0 is the flat sheet, row i + 1 the
/// i-th row of the history. Moments are about the pilot crease: dE / d(pilot angle in radians).
/// Forces are related by virtual work.
struct Actuation {
  Actuators actuators;
  std::optional<double> from_deg;  ///< given angle of use
  Eigen::Index from_row = 0;       ///< row of the angle of use: from_deg, or D; 0 where D is zero
  std::vector<double> pilot_deg;
  std::vector<double> free_mm;      ///< L0: length of each spring without force; of a cut-out
  Eigen::MatrixXd force_n;          ///< dE/dL on each diagonal, k (L - L0): positive where it pulls
  Eigen::MatrixXd moment_by_n_mm;   ///< dE/dL dL/d(pilot): each diagonal's part of the moment
  std::vector<double> energy_n_mm;  ///< k / 2 sum (L - L0)^2, or that of the plates
  std::vector<double> moment_n_mm;  ///< dE/d(pilot)
  /// Newtons on the sheet's span (between the two vertices farthest apart when flat) for each
  /// newton in every diagonal: sum |dL| / |dS|, from exact rates; NaN where the span stands still,
  /// as it does at row 0.
  std::vector<double> mechanical_advantage;
  double largest_force_n() const;  ///< maximum over springs, up to the angle of use

  struct Weakest {
    double pilot_deg, moment_n_mm;
  };
  /// The least pilot angle at which the moment counts: 5 degrees (kSlopeFrom_deg), or one degree
  /// beyond the stop of a filling.
  double counts_from_deg = kSlopeFrom_deg;
  /// The least |moment| at the samples from there to the angle of use; none if that is smaller.
  std::optional<Weakest> weakest;
  /// The fewest diagonals that keep half of that, no two of which touch; none also where the moment
  /// changes sign, or no such set is found.
  std::optional<FewDiagonals> few;
  struct OverStroke {
    double from_deg;             ///< first sample where a spring exceeds the limit
    std::vector<int> diagonals;  ///< all that exceed it up to the angle of use
  };
  std::optional<OverStroke> over_stroke;
};

/// The angle of use, `from_deg`, is a station of the sheet's history not beyond D; none: D.
Actuation actuate(const Sheet& sheet, const Actuators& actuators,
                  std::optional<double> from_deg = {});

}  // namespace misalign::solver
