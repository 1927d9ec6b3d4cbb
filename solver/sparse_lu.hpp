// The numeric half of the fixed-order elimination: straight through, no search, no branch on a
// value, no allocation, one template for double and for lanes. Every operation is written out and
// nothing is fused, so a lane has the bits of the scalar code.
#pragma once

#include <vector>

#include "solver/elimination.hpp"

namespace misalign::solver {

template <class T>
class SparseLu {
 public:
  /// `plan` must outlive this object.
  explicit SparseLu(const Elimination& plan)
      : plan_(plan),
        slots_(plan.slots, T(0)),
        inverse_pivots_(plan.equations, T(0)),
        work_(plan.equations + 1, T(0)) {}

  /// Factors the Jacobian whose nonzeros `evaluate` wrote.
  void factorize(const T* values) {
    T* const slots = slots_.data();
    for (const std::int32_t slot : plan_.fill_slots) slots[slot] = T(0);
    for (const std::int32_t slot : plan_.slot_of_value) slots[slot] = *values++;
    T* inverse = inverse_pivots_.data();
    for (const Pivot& pivot : plan_.pivots) {
      const T inverse_pivot = T(1) / slots[pivot.slot];
      *inverse++ = inverse_pivot;
      const T* const row = slots + pivot.upper.begin;
      const int length = pivot.upper.size();
      const std::int32_t* target = plan_.targets.data() + pivot.first_target;
      for (std::int32_t k = pivot.lower.begin; k < pivot.lower.end; ++k, target += length) {
        T& lower = slots[plan_.lower_slot[k]];
        const T factor = lower * inverse_pivot;
        lower = factor;
        for (int u = 0; u < length; ++u) slots[target[u]] = slots[target[u]] - factor * row[u];
      }
    }
  }

  /// y with L y = rhs: rhs one per equation, y in elimination order.
  void forward(const T* rhs, T* y) const {
    std::int32_t slot = 0;
    for (int i = 0; i < plan_.equations; ++i) {
      const Pivot& pivot = plan_.pivots[i];
      T sum = rhs[plan_.row_of[i]];
      for (; slot < pivot.slot; ++slot) sum = sum - slots_[slot] * y[plan_.column[slot]];
      y[i] = sum;
      slot = pivot.upper.end;
    }
  }

  /// The equation that is left after the elimination:
  /// partner_coefficient() dx_partner + pilot_coefficient() dx_pilot = y[n - 1].
  const T& partner_coefficient() const { return slots_[plan_.pivots.back().slot]; }
  const T& pilot_coefficient() const { return slots_.back(); }

  /// x (one per unknown) with J x = rhs, for values of the last two unknowns that satisfy the
  /// equation that is left.
  void backward(const T* y, const T& partner, const T& pilot, T* x) {
    const int n = plan_.equations;
    work_[n] = x[plan_.column_of[n]] = pilot;
    work_[n - 1] = x[plan_.column_of[n - 1]] = partner;
    for (int i = n - 2; i >= 0; --i) {
      const Stretch& upper = plan_.pivots[i].upper;
      T sum = y[i];
      for (std::int32_t u = upper.begin; u < upper.end; ++u) {
        sum = sum - slots_[u] * work_[plan_.column[u]];
      }
      work_[i] = x[plan_.column_of[i]] = sum * inverse_pivots_[i];
    }
  }

  /// x with J x = 0, for values of the last two unknowns that satisfy the equation that is left.
  void null_vector(const T& partner, const T& pilot, T* x) {
    const int n = plan_.equations;
    work_[n] = x[plan_.column_of[n]] = pilot;
    work_[n - 1] = x[plan_.column_of[n - 1]] = partner;
    for (int i = n - 2; i >= 0; --i) {
      const Stretch& upper = plan_.pivots[i].upper;
      T sum = T(0);
      for (std::int32_t u = upper.begin; u < upper.end; ++u) {
        sum = sum - slots_[u] * work_[plan_.column[u]];
      }
      work_[i] = x[plan_.column_of[i]] = sum * inverse_pivots_[i];
    }
  }

  const T& pivot(int i) const { return slots_[plan_.pivots[i].slot]; }
  const Elimination& plan() const { return plan_; }

 private:
  const Elimination& plan_;
  std::vector<T> slots_, inverse_pivots_, work_;
};

}  // namespace misalign::solver
