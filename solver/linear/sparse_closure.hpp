// Loop closure at a state, its Jacobian eliminated in the fixed order: the way a path follower
// solves its equations on every sheet that this order suits, one in each lane.
#pragma once

#include <vector>

#include "solver/linear/sparse_lu.hpp"

namespace misalign::solver {

template <class T>
class SparseClosure {
 public:
  /// Both must outlive this object.
  SparseClosure(const Mechanism& mechanism, const Elimination& elimination)
      : mechanism_(mechanism),
        lu_(elimination),
        residual_(mechanism.equations, T(0)),
        work_(mechanism.unknowns, T(0)) {}

  /// A new path in this lane.
  void restart(int) {}

  /// Residual and factors at `state`; returns how far the worst loop is open.
  T linearize(const SheetGeometry<T>& geometry, const FoldState<T>& state) {
    const T open_by = evaluate(mechanism_, geometry, state, residual_.data(), lu_.entries());
    lu_.factorize();
    lu_.forward(residual_.data(), work_.data());
    return open_by;
  }

  /// x with J x = residual: the pilot held (its entry zero), or where `is_free` is positive the
  /// pilot or its partner, whichever the equation that is left determines better. Once after each
  /// linearize().
  void solve(const T& is_free, T* x) {
    const T& s_q = lu_.partner_coefficient();
    const T& s_p = lu_.pilot_coefficient();
    const auto hold_pilot = magnitude(s_q) >= select(is_free > T(0), magnitude(s_p), T(0));
    const T rest = work_[mechanism_.equations - 1];
    lu_.backward(work_.data(), select(hold_pilot, rest / s_q, T(0)),
                 select(hold_pilot, T(0), rest / s_p), x);
  }
  /// x with J x = 0, of any length and direction.
  void null_vector(T* x) {
    lu_.null_vector(-lu_.pilot_coefficient(), lu_.partner_coefficient(), work_.data(), x);
  }

  /// Sign of det [J; t] for the unit null vector t as it was given. The last pivot is the
  /// partner's coefficient, which is t's pilot entry before scaling, and det [J; t] = det J /
  /// t_pilot for the square J.
  T orientation() const { return lu_.orientation(); }

  const SparseLu<T>& factors() const { return lu_; }

 private:
  const Mechanism& mechanism_;
  SparseLu<T> lu_;
  std::vector<T> residual_, work_;
};

}  // namespace misalign::solver
