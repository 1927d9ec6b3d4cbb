// Rejects sheets by the energy of their springs at a few converged states, where the test of every
// sample would reject them too.
#pragma once

#include <functional>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/verdict/energy_judge.hpp"
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
  /// Turning of its creases, and the sum of their lengths.
  struct Creases {
    double turning_mm, all_mm;
  };
  std::function<Creases()> find_creases = {};
};

class EnergyRejection {
 public:
  /// The model's criterion must be that of energy.
  explicit EnergyRejection(const Model& model);

  /// Begins a block of `sheets` sheets.
  void begin(int sheets);
  /// The fault that the next state of a sheet with these flat diagonals certainly shows; or none.
  Fault fault_of(int sheet, const ObservedState& now, const double* flat);
  /// Returns whether it judges energies: not those of plates, of preloads, of given free lengths
  /// and of one spring a hole.
  bool judges() const { return !rates_n_per_mm_.empty(); }

 private:
  const Model& model_;
  const double slopes_until_deg_;
  std::vector<double> rates_n_per_mm_;  // of springs on the diagonals
  bool pull_only_ = false;
  double friction_n_mm_per_mm_ = 0;                 // 0: none is demanded at the threshold
  std::vector<std::vector<DrivenSample>> samples_;  // per sheet: flat, and those seen
};

}  // namespace misalign::solver
