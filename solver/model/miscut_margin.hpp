// Finds the miscut margin: the cutting error, to first order, at which a diagonal reverses. For
// each section of the path it is the diagonal's motion over the gradient of that motion by the
// vertices. Its rank correlation with the share of miscut copies that deploy is 0.89, that of the
// least slope 0.68 (results/miscut/).
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "solver/linear/sparse_lu.hpp"
#include "solver/model/flat_gradient.hpp"

namespace misalign::solver {

/// Length of the sections in pilot angle; the last is shorter. With 5 degrees the correlation is
/// 0.91, with 30 it is 0.83.
inline constexpr double kMarginSection_deg = 20;

/// Samples at which sections end, ascending: the last is the threshold, or the last before the
/// fixed order's factors are poor.
std::vector<int> margin_samples(double sample_deg, int threshold_sample);

/// Computes the margin of one sheet in each lane.
template <class T>
class MiscutMargin {
 public:
  /// `mechanism` must outlive this object.
  explicit MiscutMargin(const Mechanism& mechanism)
      : mechanism_(mechanism),
        gradient_(mechanism),
        last_lengths_(mechanism.diagonals.size(), T(0)),
        row_(static_cast<std::size_t>(2 * mechanism.vertices), T(0)),
        last_rows_(last_lengths_.size(), row_) {}

  /// Begins a flat sheet. `geometry` must live until the next one.
  void begin(const SheetGeometry<T>& geometry) {
    geometry_ = &geometry;
    least_square_ = T(kFar * kFar);
    failed_ = T(0);
    flat_lengths(mechanism_, geometry, last_lengths_.data());
    for (std::size_t d = 0; d < last_rows_.size(); ++d) {
      last_rows_[d].assign(last_rows_[d].size(), T(0));
      add_flat_length(mechanism_, geometry, mechanism_.diagonals[d], T(1), last_rows_[d].data());
    }
  }

  /// Adds the section that ends in this closed state; `factors` are its Jacobian's.
  void see(const FoldState<T>& state, const SparseLu<T>& factors) {
    gradient_.at(*geometry_, state);
    for (std::size_t d = 0; d < last_lengths_.size(); ++d) {
      gradient_.with_pilot_held(static_cast<int>(d), factors, row_);
      T square(0);
      for (std::size_t k = 0; k < row_.size(); ++k) {
        const T change = row_[k] - last_rows_[d][k];
        square = square + change * change;
      }
      const T length = gradient_.length(static_cast<int>(d));
      const T moved = length - last_lengths_[d];
      const T ratio = moved * moved / square;
      least_square_ = select(ratio < least_square_, ratio, least_square_);
      failed_ = failed_ + (ratio - ratio);
      last_lengths_[d] = length;
      last_rows_[d].swap(row_);
    }
  }

  /// Least margin of the sheet in lane i over all diagonals and sections so far: the root of the
  /// sum of squares of all vertex errors of the nearest sheet on which the diagonal does not move.
  /// None if the solver failed, that is, if a value is not finite.
  std::optional<double> mm(int i) const {
    if (!std::isfinite(lane(failed_, i))) return std::nullopt;
    return std::sqrt(lane(least_square_, i)) * mechanism_.panel_width_mm;
  }

 private:
  static constexpr double kFar = 1e6;  // panel widths; beyond any distance

  const Mechanism& mechanism_;
  FlatGradient<T> gradient_;
  const SheetGeometry<T>* geometry_ = nullptr;
  std::vector<T> last_lengths_, row_;
  std::vector<std::vector<T>> last_rows_;  // per diagonal: its gradient at the last section's end
  T least_square_ = T(0);
  T failed_ = T(0);  // not a number once the solver failed
};

}  // namespace misalign::solver
