// Rejects sheets by the energy of their springs at a few converged states, where the test of every
// sample would reject them too.
#pragma once

#include <vector>

#include "solver/model/model.hpp"
#include "solver/verdict/driving_energy.hpp"
#include "solver/verdict/fault.hpp"

namespace misalign::solver {

/// One state of a sheet, its diagonals in panel widths and per radian of arc length along its
/// path.
struct ObservedState {
  double pilot_deg;
  int sample;           ///< sample of this exact angle; 0: none
  double pilot_rate;    ///< pilot's rate per arc length; not positive: it turned back
  double farthest_deg;  ///< largest pilot angle on the way to this state
  const double* lengths;
  double length_error;
  const double* slopes;
  double slope_error;
  double turning_mm = 0;  ///< turning of its creases, at a sample if needs_turning()
};

/// Springs without preload alone: what preload and plates need, lengths at some states do not show.
class EnergyRejection {
 public:
  /// The model's criterion must be that of energy.
  explicit EnergyRejection(const Model& model);

  /// Begins a block of `sheets` sheets.
  void begin(int sheets);
  /// The fault that the next state of a sheet with these flat diagonals certainly shows; or none.
  Fault fault_of(int sheet, const ObservedState& now, const double* flat);
  /// Returns whether states at samples need the turning of their creases.
  bool needs_turning() const { return friction_n_mm_per_mm_ > 0; }

 private:
  struct Sample {
    int sample;
    double energy_n_mm, error_n_mm, turning_mm;
  };

  const Model& model_;
  const double slopes_until_deg_;
  DrivingEnergy energy_;
  double friction_n_mm_per_mm_ = 0;  // 0: none is demanded at the threshold
  std::vector<double> flat_, lengths_, forces_n_, stiffness_n_per_mm_;
  std::vector<std::vector<Sample>> samples_;  // per sheet
};

}  // namespace misalign::solver
