// Solves with the factors of the fixed-order elimination: without search, branch on a value or
// allocation, in one template for double and for lanes. Every operation is written out and none is
// fused, so a lane has the bits of the scalar code.
#pragma once

#include <algorithm>
#include <vector>

#include "solver/kinematics/lane_math.hpp"
#include "solver/linear/elimination_pass.hpp"
#include "solver/linear/large_pages.hpp"

namespace misalign::solver {

template <class T>
class SparseLu {
 public:
  /// `plan` must outlive this object.
  explicit SparseLu(const Elimination& plan)
      : plan_(plan),
        slots_(plan.slots + plan.most_packed, T(0)),
        inverse_pivots_(plan.equations, T(0)) {}

  /// Copies factors of another precision, rounded.
  template <class U>
  explicit SparseLu(const SparseLu<U>& other) : SparseLu(other.plan()) {
    std::transform(other.slots_.begin(), other.slots_.end(), slots_.begin(),
                   [](const U& value) { return static_cast<T>(value); });
    std::transform(other.inverse_pivots_.begin(), other.inverse_pivots_.end(),
                   inverse_pivots_.begin(), [](const U& value) { return static_cast<T>(value); });
  }

  /// Iterator by which `evaluate` writes the Jacobian's nonzeros into their slots.
  class Entry {
   public:
    Entry(T* slots, const std::int32_t* slot) : slots_(slots), slot_(slot) {}
    T& operator*() const { return slots_[*slot_]; }
    Entry operator++(int) { return {slots_, slot_++}; }

   private:
    T* slots_;
    const std::int32_t* slot_;
  };
  Entry entries() { return {slots_.data(), plan_.slot_of_value.data()}; }

  /// Takes over the factors of `other`, in the lanes where `choice` is positive.
  void replace(const T& choice, const SparseLu& other) {
    const auto chosen = choice > T(0);
    for (std::int32_t k = 0; k < plan_.slots; ++k) {
      slots_[k] = select(chosen, other.slots_[k], slots_[k]);
    }
    for (std::size_t k = 0; k < inverse_pivots_.size(); ++k) {
      inverse_pivots_[k] = select(chosen, other.inverse_pivots_[k], inverse_pivots_[k]);
    }
  }

  /// Factors the Jacobian that was written to entries().
  void factorize() { eliminate(nullptr); }
  /// Factors it and finds y with L y = rhs, as forward() would, while L is in the cache.
  void factorize(const T* rhs, T* y) {
    for (int i = 0; i < plan_.equations; ++i) y[i] = rhs[plan_.row_of[i]];
    eliminate(y);
  }

  /// y with L y = rhs: rhs one per equation, y in elimination order. V is T, or lanes that share
  /// factors of type double.
  template <class V>
  void forward(const V* rhs, V* y) const {
    std::int32_t slot = 0;
    for (int i = 0; i < plan_.equations; ++i) {
      const Elimination::Pivot& pivot = plan_.pivots[i];
      V sum = rhs[plan_.row_of[i]];
      for (; slot < pivot.slot; ++slot) sum = sum - V(slots_[slot]) * y[plan_.column[slot]];
      y[i] = sum;
      slot = pivot.upper.end;
    }
  }

  /// The last equation after the elimination: partner_coefficient() dx_partner +
  /// pilot_coefficient() dx_pilot = y[n - 1].
  const T& partner_coefficient() const { return slots_[plan_.pivots.back().slot]; }
  const T& pilot_coefficient() const { return slots_[plan_.slots - 1]; }

  /// x (one per unknown) with J x = rhs, for values of the last two unknowns that satisfy the last
  /// equation; `y`, with room for one more value, is overwritten.
  template <class V>
  void backward(V* y, const V& partner, const V& pilot, V* x) const {
    const int n = plan_.equations;
    x[plan_.column_of[n]] = y[n] = pilot;
    x[plan_.column_of[n - 1]] = y[n - 1] = partner;
    for (int i = n - 2; i >= 0; --i) {
      const Elimination::Range& upper = plan_.pivots[i].upper;
      V sum = y[i];
      for (std::int32_t u = upper.begin; u < upper.end; ++u) {
        sum = sum - V(slots_[u]) * y[plan_.column[u]];
      }
      x[plan_.column_of[i]] = y[i] = sum * V(inverse_pivots_[i]);
    }
  }

  /// Solves with the pilot held; `y` is the result of forward().
  template <class V>
  void backward_held(V* y, V* x) const {
    backward(y, y[plan_.equations - 1] / V(partner_coefficient()), V(0), x);
  }

  /// Finds x from `y` with `pilot` and `partner`, and the null vector with its own values of both,
  /// in one pass over the factors. `null_work` has room for one value per unknown.
  void backward_with_null_vector(T* y, const T& partner, const T& pilot, T* x,
                                 const T& null_partner, const T& null_pilot, T* null_work,
                                 T* null) const {
    const int n = plan_.equations;
    const auto set = [&](int i, const T& of_x, const T& of_null) {
      x[plan_.column_of[i]] = y[i] = of_x;
      null[plan_.column_of[i]] = null_work[i] = of_null;
    };
    set(n, pilot, null_pilot);
    set(n - 1, partner, null_partner);
    for (int i = n - 2; i >= 0; --i) {
      const Elimination::Range& upper = plan_.pivots[i].upper;
      T sum = y[i], null_sum(0);
      for (std::int32_t u = upper.begin; u < upper.end; ++u) {
        const std::int32_t column = plan_.column[u];
        sum = sum - slots_[u] * y[column];
        null_sum = null_sum - slots_[u] * null_work[column];
      }
      set(i, sum * inverse_pivots_[i], null_sum * inverse_pivots_[i]);
    }
  }

  /// x with J x = 0, for values of the last two unknowns that satisfy the last equation; `work` has
  /// room for one value per unknown.
  template <class V>
  void null_vector(const V& partner, const V& pilot, V* work, V* x) const {
    for (int i = 0; i < plan_.equations; ++i) work[i] = V(0);
    backward(work, partner, pilot, x);
  }

  /// x (one per equation) with J^T x = rhs (one per unknown but the pilot), J without the pilot's
  /// column. `work` has room for one value per equation.
  void transposed(const T* rhs, T* work, T* x) const {
    const int n = plan_.equations;
    for (int i = 0; i < n; ++i) {
      const Elimination::Range& above = plan_.pivots[i].above;
      T sum = rhs[plan_.column_of[i]];
      for (std::int32_t k = above.begin; k < above.end; ++k) {
        sum = sum - slots_[plan_.above_slot[k]] * work[plan_.above_row[k]];
      }
      work[i] = sum * inverse_pivots_[i];
    }
    for (int i = n - 1; i >= 0; --i) {
      const Elimination::Range& lower = plan_.pivots[i].lower;
      T sum = work[i];
      for (std::int32_t k = lower.begin; k < lower.end; ++k) {
        sum = sum - slots_[plan_.lower_slot[k]] * work[plan_.lower_row[k]];
      }
      x[plan_.row_of[i]] = work[i] = sum;
    }
  }

  const T& pivot(int i) const { return slots_[plan_.pivots[i].slot]; }
  /// Sign of the determinant of the first n - 1 equations and columns.
  T orientation() const {
    T sign(static_cast<Scalar<T>>(plan_.permutation_sign));
    for (int i = 0; i + 1 < plan_.equations; ++i) {
      sign = select(pivot(i) < T(0), -sign, sign);
    }
    return sign;
  }
  /// Sign of the determinant of the Jacobian without the pilot's column.
  T determinant_sign() const {
    const T sign = orientation();
    return select(partner_coefficient() < T(0), -sign, sign);
  }
  const Elimination& plan() const { return plan_; }

 private:
  template <class U>
  friend class SparseLu;

  void eliminate(T* y) {
    T* const packed = slots_.data() + plan_.slots;
    EliminationPass<T>(plan_, slots_.data(), inverse_pivots_.data(), packed, y).run();
  }

  const Elimination& plan_;
  std::vector<T, LargePages<T>> slots_;  // with room for an EliminationPass
  std::vector<T> inverse_pivots_;
};

/// Presents the factors as those of the square Jacobian, without the pilot's column.
template <class T>
class SquareFactors {
 public:
  explicit SquareFactors(const SparseLu<T>& lu)
      : lu_(lu),
        equations_(lu.plan().equations),
        y_(equations_ + 1, T(0)),
        x_(equations_ + 1, T(0)) {}

  void solve(const T* rhs, T* x) {
    lu_.forward(rhs, y_.data());
    lu_.backward_held(y_.data(), x_.data());
    for (int j = 0; j < equations_; ++j) x[j] = x_[j];
  }
  void solve_transposed(const T* rhs, T* x) { lu_.transposed(rhs, y_.data(), x); }

 private:
  const SparseLu<T>& lu_;
  const int equations_;
  std::vector<T> y_, x_;
};

}  // namespace misalign::solver
