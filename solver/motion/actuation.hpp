// What springs or wires on the diagonals of the holes store on the way, and how hard they drive the
// sheet back to flat (Saito, Tsukahara & Okabe 2016, sections 5 and 6).
#pragma once

#include <optional>
#include <vector>

#include "solver/motion/actuators.hpp"
#include "solver/motion/few_diagonals.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

/// The share of its least moment that the smallest set of diagonals must keep.
inline constexpr double kShareOfFew = 0.5;

/// How springs of `Actuators` behave along a path. Row 0 is the flat sheet, row i + 1 the i-th row
/// of the history. The moment is taken about the pilot crease: that of springs that let go by
/// dE is dE / d(pilot angle in radians). Forces are related by virtual work.
struct Actuation {
  Actuators actuators;
  std::optional<double> from_deg;  ///< as asked
  Eigen::Index from_row = 0;       ///< of the angle of use: that, or D; 0 where it is nothing
  std::vector<double> pilot_deg;
  std::vector<double> free_mm;      ///< how long each spring is without force: L0
  Eigen::MatrixXd force_n;          ///< k (L - L0): positive where the spring pulls
  Eigen::MatrixXd moment_by_n_mm;   ///< k (L - L0) dL/d(pilot): what each adds to the moment
  std::vector<double> energy_n_mm;  ///< k / 2 sum (L - L0)^2
  std::vector<double> moment_n_mm;  ///< dE/d(pilot)
  /// Newtons on the sheet's span (between the two vertices farthest apart when flat) for each
  /// newton in every diagonal: sum |dL| / |dS|, from exact rates; NaN where the span stands still,
  /// as it does at row 0.
  std::vector<double> mechanical_advantage;
  double largest_force_n() const;  ///< of all springs, up to the angle of use

  struct Weakest {
    double pilot_deg, moment_n_mm;
  };
  /// The least |moment| at the samples from 5 degrees (kSlopeFrom_deg) to the angle of use; none if
  /// that lies below.
  std::optional<Weakest> weakest;
  /// The fewest diagonals that keep half of that; none also where the moment turns round.
  std::optional<FewDiagonals> few;
  struct OverStroke {
    double from_deg;             ///< the first sample up to there where one exceeds the limit
    std::vector<int> diagonals;  ///< all that do, up to there
  };
  std::optional<OverStroke> over_stroke;
};

/// Used from `from_deg`, a station of the sheet's history not beyond D; none: from D.
Actuation actuate(const Sheet& sheet, const Actuators& actuators,
                  std::optional<double> from_deg = {});

}  // namespace misalign::solver
