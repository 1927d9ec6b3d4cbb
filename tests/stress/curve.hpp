// The solution curve of one sheet by dense matrices alone, past the turning points of its pilot:
// the tangent from an orthogonal factorisation, corrections of least norm. Shares loop_closure with
// the program, nothing of its continuation.
#pragma once

#include <Eigen/QR>
#include <cmath>
#include <functional>
#include <memory>

#include "solver/linear/newton.hpp"

namespace misalign::stress {

class Curve {
 public:
  Curve(const solver::Mechanism& mechanism, const solver::SheetGeometry<double>& geometry,
        const solver::FoldState<double>& start)
      : mechanism_(mechanism),
        geometry_(geometry),
        system_(std::make_shared<solver::ClosureSystem>(mechanism)),
        state_(start) {
    tangent_ = Eigen::VectorXd::Unit(mechanism.unknowns, mechanism.unknowns - 1);
    turn_tangent();
  }

  const solver::FoldState<double>& state() const { return state_; }
  double pilot_deg() const { return solver::angle_deg(state_.creases[mechanism_.get().pilot]); }
  /// Rate of the pilot along the curve.
  double pilot_rate() const { return tangent_[mechanism_.get().unknowns - 1]; }
  void reverse() { tangent_ = -tangent_; }

  /// A step of at most `longest_rad`; false if none could be made.
  bool step(double longest_rad) {
    const solver::FoldState<double> from = state_;
    const Eigen::VectorXd before = tangent_;
    for (double ds = std::min(longest_rad, 2 * last_step_); ds > 1e-12; ds *= 0.5) {
      state_ = from;
      tangent_ = before;
      solver::advance(mechanism_, Eigen::VectorXd(ds * before).data(), state_);
      if (correct() && turn_tangent() && tangent_.dot(before) > 0.999) {
        last_step_ = ds;
        return true;
      }
    }
    state_ = from;
    tangent_ = before;
    return false;
  }

  /// Walks until the pilot turns; its angle there, degrees, to 1e-9 of them.
  double walk_to_turn(double longest_rad) {
    const double sign = pilot_rate() > 0 ? 1 : -1;
    double longest = longest_rad;
    for (int k = 0; k < 20000; ++k) {
      const solver::FoldState<double> from = state_;
      const Eigen::VectorXd before = tangent_;
      if (!step(longest)) return std::nan("");
      if (pilot_rate() * sign > 0) continue;
      if (last_step_ < 1e-8) return pilot_deg();
      // Once more from before it, to where the rate would vanish if it went on like this.
      const double share = before[mechanism_.get().unknowns - 1] /
                           (before[mechanism_.get().unknowns - 1] - pilot_rate());
      longest = last_step_ * std::clamp(share, 0.05, 0.95);
      last_step_ = longest;
      state_ = from;
      tangent_ = before;
    }
    return std::nan("");
  }

 private:
  // To the curve, at right angles to the tangents of its neighbours.
  bool correct() {
    for (int k = 0; k < 8; ++k) {
      const double open = system_->evaluate(geometry_, state_);
      if (!std::isfinite(open)) return false;
      if (open <= 1e-13 || (k > 3 && open <= 1e-12)) return true;
      const Eigen::VectorXd turn =
          -system_->jacobian().completeOrthogonalDecomposition().solve(system_->residual());
      if (turn.cwiseAbs().maxCoeff() > 0.3) return false;
      solver::advance(mechanism_, turn.data(), state_);
    }
    return false;
  }
  bool turn_tangent() {
    system_->evaluate(geometry_, state_);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(system_->jacobian().transpose());
    Eigen::VectorXd last =
        Eigen::VectorXd::Unit(mechanism_.get().unknowns, mechanism_.get().unknowns - 1);
    last = qr.householderQ() * last;
    if (!last.allFinite()) return false;
    tangent_ = last.dot(tangent_) < 0 ? Eigen::VectorXd(-last) : last;
    return true;
  }

  std::reference_wrapper<const solver::Mechanism> mechanism_;
  std::reference_wrapper<const solver::SheetGeometry<double>> geometry_;
  std::shared_ptr<solver::ClosureSystem> system_;  // copies of a curve share the workspace
  solver::FoldState<double> state_;
  Eigen::VectorXd tangent_;
  double last_step_ = 0.01;
};

}  // namespace misalign::stress
