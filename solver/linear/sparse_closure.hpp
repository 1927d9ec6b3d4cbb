// Solves loop closure at a state by elimination in the fixed order, for sheets that this order
// suits, one in each lane.
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
        work_(mechanism.unknowns, T(0)),
        null_work_(work_) {}

  /// Begins a new path in a lane.
  void restart(int) {}

  /// Residual and factors at `state`; returns the opening of the worst loop.
  template <class Geometry>
  T linearize(const Geometry& geometry, const FoldState<T>& state) {
    const T open_by = evaluate(mechanism_, geometry, state, residual_.data(), lu_.entries());
    lu_.factorize(residual_.data(), work_.data());
    return open_by;
  }

  /// Finds x with J x = residual, and `null` with J null = 0 (of any length and direction). The
  /// pilot is held (its entry zero); where `is_free` is positive, the pilot or its partner is held,
  /// and the last equation gives the other, whichever it determines better. Call it once after each
  /// linearize().
  void solve(const T& is_free, T* x, T* null) {
    const T& s_q = lu_.partner_coefficient();
    const T& s_p = lu_.pilot_coefficient();
    const auto hold_pilot = magnitude(s_q) >= select(is_free > T(0), magnitude(s_p), T(0));
    const T rest = work_[mechanism_.equations - 1];
    lu_.backward_with_null_vector(work_.data(), select(hold_pilot, rest / s_q, T(0)),
                                  select(hold_pilot, T(0), rest / s_p), x, -s_p, s_q,
                                  null_work_.data(), null);
  }

  /// Sign of det [J; t] for the unit null vector t of `solve`. The last pivot is the partner's
  /// coefficient, which is t's pilot entry before scaling, and det [J; t] = det J / t_pilot for the
  /// square J.
  T orientation() const { return lu_.orientation(); }

  const SparseLu<T>& factors() const { return lu_; }

 private:
  const Mechanism& mechanism_;
  SparseLu<T> lu_;
  std::vector<T> residual_, work_, null_work_;
};

}  // namespace misalign::solver
