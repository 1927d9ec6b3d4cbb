// Measures the solved states of one sheet in each lane from factors of their Jacobians: quality,
// the diagonals' lengths and rates of change, and miscut margins.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "solver/judging/sheet_queue.hpp"
#include "solver/linear/held_correction.hpp"
#include "solver/linear/singular_value.hpp"
#include "solver/model/miscut_margin.hpp"
#include "solver/model/model.hpp"

namespace misalign::solver {

/// Quality of a solved state.
struct SolveQuality {
  double open_by;             ///< largest closure entry: radians, panel widths
  double singular_value_min;  ///< the square Jacobian's
  double isometry_error;      ///< panel widths
};

template <class T>
class StateMeasure {
 public:
  /// `model` must outlive this object.
  explicit StateMeasure(const Model& model)
      : model_(model),
        mechanism_(model.mechanism()),
        placed_(mechanism_),
        geometry_(lane_geometry<T>(mechanism_)),
        state_(flat_state<T>(mechanism_)),
        factors_(model.elimination()),
        square_factors_(factors_),
        smallest_(mechanism_.equations),
        residual_(mechanism_.equations, T(0)),
        work_(mechanism_.unknowns, T(0)),
        rates_(work_),
        lengths_(mechanism_.diagonals.size(), T(0)),
        slopes_(lengths_),
        margin_(mechanism_) {}

  /// Puts the sheets from sheets[first] on into lanes; spare lanes have the last one.
  void put(const SheetBlock& block, const std::vector<int>& sheets, std::size_t first) {
    for (int i = 0; i < kLanes<T>; ++i) {
      sheet_of_lane_[i] = sheets[std::min(first + static_cast<std::size_t>(i), sheets.size() - 1)];
      put_lane(placed_.of(block, sheet_of_lane_[i]), geometry_, i);
    }
  }
  int sheet(int lane) const { return sheet_of_lane_[lane]; }
  const SheetGeometry<T>& geometry() const { return geometry_; }

  FoldState<T>& state() { return state_; }
  /// Factors of the state's Jacobian: copied from its solver, or made by factorize().
  SparseLu<T>& factors() { return factors_; }
  void factorize() {
    evaluate(mechanism_, geometry_, state_, residual_.data(), factors_.entries());
    factors_.factorize();
  }
  /// Corrects the state with its pilot held, by new factors or the present ones.
  void correct(bool new_factors) {
    correct_held(mechanism_, geometry_, new_factors, factors_, residual_, work_, rates_, state_);
  }

  /// Restarts the search for a lane's least singular value.
  void restart(int lane) { smallest_.restart(lane); }
  void find_closure(const SheetGeometry<T>& geometry) {
    open_by_ = evaluate(mechanism_, geometry, state_, residual_.data(), nullptr);
  }
  void find_condition(const SheetGeometry<T>& geometry, const T& wanted = T(1)) {
    singular_value_ = smallest_.of(square_factors_, wanted);
    model_.shape().place(geometry, state_, points_);
    isometry_error_ = model_.shape().isometry_error(geometry, points_);
  }
  /// Results of find_closure and find_condition.
  SolveQuality quality(int i) const {
    return {lane(open_by_, i), lane(singular_value_, i), lane(isometry_error_, i)};
  }

  void find_slopes(const SheetGeometry<T>& geometry) {
    factors_.null_vector(-factors_.pilot_coefficient() / factors_.partner_coefficient(), T(1),
                         work_.data(), rates_.data());
    folded_lengths_and_slopes(mechanism_, geometry, state_, rates_.data(), lengths_.data(),
                              slopes_.data(), residual_.data());
  }
  /// Misfit after find_slopes, as in PathPoint.
  T misfit() const {
    T most(0);
    for (const T& rest : residual_) most = larger(most, magnitude(rest));
    return most;
  }
  T pilot_rate() const {
    using std::sqrt;
    T square(0);
    for (const T& rate : rates_) square = square + rate * rate;
    return T(1) / sqrt(square);
  }
  void copy_rates(int i, std::vector<double>& rates) const { copy(rates_, i, rates); }
  void copy_slopes(int i, std::vector<double>& lengths, std::vector<double>& slopes) const {
    copy(lengths_, i, lengths);
    copy(slopes_, i, slopes);
  }

  MiscutMargin<T>& margin() { return margin_; }

 private:
  static void copy(const std::vector<T>& lanes, int i, std::vector<double>& values) {
    values.resize(lanes.size());
    for (std::size_t k = 0; k < lanes.size(); ++k) values[k] = lane(lanes[k], i);
  }

  const Model& model_;
  const Mechanism& mechanism_;
  PlacedSheet placed_;
  std::array<int, kLanes<T>> sheet_of_lane_{};
  SheetGeometry<T> geometry_;
  FoldState<T> state_;
  SparseLu<T> factors_;
  SquareFactors<T> square_factors_;
  SmallestSingularValue<T> smallest_;
  FoldedShape::Points<T> points_;
  std::vector<T> residual_, work_, rates_, lengths_, slopes_;
  T open_by_, singular_value_, isometry_error_;
  MiscutMargin<T> margin_;
};

}  // namespace misalign::solver
