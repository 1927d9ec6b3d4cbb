// Counts the diagonals of a sheet that need no spring, with a fraction.
#pragma once

#include <optional>

#include "solver/motion/energy_model.hpp"
#include "solver/motion/few_diagonals.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

/// Springs on `few.diagonals` keep kShareOfFew of the least moment of all, at every sample from
/// kSlopeFrom_deg and at the angle of use, as in actuate(), but springs that touch are
/// not excluded.
struct SpareDiagonals {
  FewDiagonals few;
  Eigen::VectorXd pilot_deg;  ///< angles at which moments are evaluated

  /// Number of diagonals without a spring, plus a fraction that tells how close one spring fewer is
  /// to sufficing.
  double amount;
};

/// Returns none where springs do not drive the sheet to flat all the way.
std::optional<SpareDiagonals> spare_diagonals(const Sheet& sheet, const EnergyModel& rigid,
                                              double from_deg);

}  // namespace misalign::solver
