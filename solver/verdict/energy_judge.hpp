// Judges the samples of a path by the filling's energy (EnergyCriterion), one after the other.
//
// The energy rises from sample to sample if it grows by more than a change of every diagonal by
// kStepBand_widths would make: an energy that is convex in the lengths rises on no unshifted sheet.
// The margins are judged at the threshold. The critical friction from there is the largest f with
// E(from) - E(rho) >= f (turning(from) - turning(rho)) at every sample below, and flat: where
// creases fold back, so that the turning does not fall, any energy that falls is enough.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "solver/fill/filling.hpp"
#include "solver/kinematics/fold_state.hpp"
#include "solver/verdict/criterion.hpp"
#include "solver/verdict/score.hpp"

namespace misalign::solver {

/// A number and bounds of it.
struct Bounded {
  double value = 0, error = 0;
  double low() const { return value - error; }
  double high() const { return value + error; }
};

/// Least ratio of a quantity to what is demanded of it, with its bounds.
struct DriveRatio {
  double value = std::numeric_limits<double>::infinity();
  double low = value, high = value;

  /// Takes a ratio of `has` to `needs`; where nothing is needed it has no effect.
  void take(const Bounded& has, const Bounded& needs);
  /// Returns whether it is at least 1, if that is certain.
  std::optional<bool> is_met() const;
  bool has_certain_score() const {
    return scores_of(std::min(low, 1.0)) == scores_of(std::min(high, 1.0));
  }
};

/// Energy, and turning of all creases, at a sample.
struct DrivenSample {
  Bounded energy_n_mm, turning_mm;
};
/// Least ratio of the energy's rise from each sample before to the work of this friction, and
/// `least`.
DriveRatio friction_ratio(const DrivenSample& now, const std::vector<DrivenSample>& before,
                          double friction_n_mm_per_mm, DriveRatio least = {});

class EnergyJudge {
 public:
  EnergyJudge(const Mechanism& mechanism, const EnergyCriterion& criterion);

  int from_sample() const { return criterion_.from_sample; }
  bool asks_for_turning() const { return criterion_.least_friction_n_mm_per_mm > 0; }
  bool asks_for_moment() const { return criterion_.least_moment_n_mm > 0; }
  /// Begins a path; lengths here and below are the diagonals', in panel widths. Friction and plates
  /// need the sheet's geometry.
  void begin(const std::vector<double>& flat_lengths, const SheetGeometry<double>* geometry);
  /// Looks at the next sample. Without `errors` its lengths are exact.
  void look(const std::vector<double>& lengths, const std::vector<double>* errors = nullptr);
  /// Returns whether the energy has risen since the last sample.
  bool rises() const { return step_n_mm() > band_n_mm_; }
  /// Returns whether that is certain, and pulls_back() too if it has not.
  bool is_decisive() const;
  /// The diagonal whose part of the energy has fallen most since the last sample.
  int pulls_back() const { return pulls_back_; }
  /// Part of a sample by which a rise was missed, by the parabola through three energies.
  LeastPart missed_part() const;

  /// Sets the creases of the sample looked at: sines and cosines have this error.
  void set_creases(const std::vector<HalfAngle<double>>& creases, double error = 0);
  void set_turning(double turning_mm) { now_.turning_mm = {turning_mm}; }
  /// Sets the moment of the sample looked at by the diagonals' slopes, whose Euclidean norm has
  /// this relative error.
  void set_slopes(const std::vector<double>& slopes, double relative_error = 0);
  /// Least ratio of what drives the sheet to what is asked, if the sample looked at is the
  /// threshold.
  DriveRatio drive() const;
  /// Accepts the sample looked at.
  void take();
  /// Energy at these lengths, N mm; springs have their sides once a sample was looked at.
  double energy_n_mm(const std::vector<double>& lengths) {
    return energy_at(lengths, nullptr, forces_n_).value;
  }
  /// Corrects the lengths at the last sample taken.
  void correct_last(const std::vector<double>& lengths, const std::vector<double>* errors);

 private:
  double step_n_mm() const { return now_.energy_n_mm.value - samples_.back().energy_n_mm.value; }
  void set_sides(const std::vector<double>& first_lengths);
  void find_who_pulls_back();
  Bounded energy_at(const std::vector<double>& lengths, const std::vector<double>* errors,
                    std::vector<double>& forces_n);

  const Mechanism& mechanism_;
  const EnergyCriterion criterion_;
  const double width_mm_;
  const bool needs_sides_;  // true of preloads, and of one spring a hole
  HoleDiagonals holes_;
  FlatVertices vertices_mm_;  // only of plates
  Filling filling_;           // the sheet's
  std::vector<double> creases_mm_;
  double all_creases_mm_ = 0, band_n_mm_ = 0;
  std::vector<DrivenSample> samples_;  // flat, and those taken
  DrivenSample now_;
  std::vector<double> lengths_, last_lengths_, errors_, last_errors_;
  std::vector<double> forces_n_, last_forces_n_, stiffness_n_per_mm_;
  int pulls_back_ = -1;
  bool is_sure_who_ = true;
  DriveRatio moment_, moment_now_;
};

}  // namespace misalign::solver
