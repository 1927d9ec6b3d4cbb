// The energy of a folded sheet as a smooth function of its pilot's angle, from a few angles.
#pragma once

#include <Eigen/Core>

namespace misalign::solver {

/// Energies change from the fourth power of the angle to the second where panels bend, and begin
/// with the second where springs are preloaded. So their ratio to a positive reference that does
/// the same is interpolated, over the angle's logarithm.
class EnergyCurve {
 public:
  struct At {
    double n_mm;       ///< energy above that of flat
    double turned_mm;  ///< sum over the creases of length times |fold angle|
    double moment_n;   ///< d energy / d turned: N mm per mm
  };
  EnergyCurve(double least_deg, double most_deg, const Eigen::VectorXd& above_flat_n_mm,
              const Eigen::VectorXd& reference_n_mm, const Eigen::VectorXd& turned_mm);
  /// Angles (deg) at which the energies must be given.
  static Eigen::VectorXd angles_deg(double least_deg, double most_deg, int count);

  double least_deg() const { return least_deg_; }
  double most_deg() const { return most_deg_; }
  At at(double pilot_deg) const;

 private:
  // The polynomial through values at the extremes of Chebyshev's polynomial on an interval, both
  // ends among them.
  class Series {
   public:
    static Eigen::VectorXd points(double low, double high, int count);

    Series() = default;
    // `values` at points(low, high, values.size()).
    Series(double low, double high, const Eigen::VectorXd& values);
    struct Value {
      double value, slope;
    };
    Value at(double place) const;

   private:
    double low_ = -1, high_ = 1;
    Eigen::VectorXd coefficients_;
  };

  double least_deg_, most_deg_;
  Series share_, log_reference_, log_turned_;
};

}  // namespace misalign::solver
