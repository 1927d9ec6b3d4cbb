// Gives the energy of a filling that is relaxed flat, sheet after sheet of one mechanism, without
// allocating memory.
#pragma once

#include <algorithm>
#include <vector>

#include "solver/fill/fill.hpp"
#include "solver/fill/hole_energy.hpp"
#include "solver/kinematics/fold_state.hpp"

namespace misalign::solver {

class DrivingEnergy {
 public:
  /// The filling must be relaxed flat, apart from preload or pre-stretch.
  DrivingEnergy(const Mechanism& mechanism, const Fill& fill);

  /// Begins a sheet whose diagonals have these flat lengths (panel widths); plates need its
  /// geometry.
  void begin(const std::vector<double>& flat_lengths, const SheetGeometry<double>* geometry);
  /// Sets the sides of preloaded springs by the lengths at the first sample: the change of each.
  void set_sides(const std::vector<double>& first_lengths);

  /// Energy (N mm) at these lengths (panel widths). `forces_n` gets its derivatives by the lengths,
  /// `stiffness_n_per_mm` bounds of the forces' changes by any one length.
  double look(const std::vector<double>& lengths, std::vector<double>& forces_n,
              std::vector<double>& stiffness_n_per_mm) const;

  /// Returns whether it is springs without force on the flat sheet.
  bool is_relaxed_flat() const {
    return !plates_ && !has_preload_ &&
           std::ranges::none_of(free_mm_, [](const auto& free_mm) { return free_mm.has_value(); });
  }
  /// Returns whether some springs are preloaded.
  bool has_preload() const { return has_preload_; }
  bool has_plates() const { return plates_.has_value(); }

 private:
  void cut_plates(const SheetGeometry<double>& geometry);

  const std::vector<Diagonal> diagonals_;
  const double width_mm_;
  bool has_preload_ = false, pull_only_ = false;
  std::vector<double> rates_n_per_mm_, preload_n_;
  std::vector<std::optional<double>> free_mm_;  // given ones
  std::vector<double> flat_mm_, relaxed_mm_;
  std::optional<RubberPlates> plates_;
  std::vector<std::array<double, 2>> ratios_;  // per hole: cut-out's diagonals to the flat ones
  std::vector<double> products_mm2_;
  std::vector<PlateLaw> laws_;
};

/// Lengths of the creases, mm.
void find_crease_lengths(const Mechanism& mechanism, const SheetGeometry<double>& geometry,
                         std::vector<double>& creases_mm);

/// Sum over all creases of length times |fold angle|, mm: the friction of 1 N mm per mm does this
/// work (N mm) from flat if no crease turns back.
double turning_mm(const std::vector<double>& creases_mm,
                  const std::vector<HalfAngle<double>>& creases);

}  // namespace misalign::solver
