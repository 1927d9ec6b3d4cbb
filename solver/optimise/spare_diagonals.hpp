// How many diagonals of a sheet need no spring, in steps and between them.
#pragma once

#include <optional>

#include "solver/motion/energy_model.hpp"
#include "solver/motion/few_diagonals.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

/// Springs on `few.diagonals` keep kShareOfFew of the least moment of all, at every sample from
/// kSlopeFrom_deg and at the angle of use, as actuate() has it.
struct SpareDiagonals {
  FewDiagonals few;
  Eigen::VectorXd pilot_deg;  ///< where moments are evaluated

  /// Diagonals without a spring, and how near one more is to being enough.
  double amount;
};

/// None where its springs do not drive it to flat all the way.
std::optional<SpareDiagonals> spare_diagonals(const Sheet& sheet, const EnergyModel& rigid,
                                              double from_deg);

}  // namespace misalign::solver
