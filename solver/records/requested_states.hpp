// Lists the states of a path that its record needs exactly, each with a near state and a pilot
// angle.
#pragma once

#include <vector>

#include "solver/model/model.hpp"
#include "solver/records/state_measure.hpp"

namespace misalign::solver {

/// A state to be solved: close to `near`, with the pilot at this angle.
struct RequestedState {
  int sample = 0;  ///< 0: none
  double pilot_deg = 0;
  HalfAngle<double> pilot{1, 0};
  FoldState<double> near;
};

/// The solution at a requested state.
struct SolvedState {
  SolveQuality quality;
  std::vector<double> lengths, slopes;  ///< panel widths, per radian of pilot
};

/// Results at the requested states of one path in each lane. They are constructed and destroyed
/// outside of lanes' code, whose instructions not every machine has.
class SolvedStates {
 public:
  SolvedStates(const Model& model, int lanes);
  ~SolvedStates();
  std::vector<SolvedState>& operator[](int lane) {
    return of_lanes_[static_cast<std::size_t>(lane)];
  }

 private:
  std::vector<std::vector<SolvedState>> of_lanes_;
};

/// The purpose of a requested state, beside those of the model's margin_samples.
enum class Purpose {
  first,
  second,
  before_d,
  at_d,
  before_least_step,
  after_least_step,
  least_slope,
  reversal
};
inline constexpr int kPurposes = 8;

/// Requested states of one path: at the model's margin_samples, then for each Purpose in order.
class RequestedStates {
 public:
  /// Empties the list. `model` must outlive this object.
  void begin(const Model& model);

  int count() const { return static_cast<int>(states_.size()); }
  int index_of(Purpose purpose) const { return count() - kPurposes + static_cast<int>(purpose); }
  const RequestedState& operator[](int k) const { return states_[static_cast<std::size_t>(k)]; }
  const RequestedState& of(Purpose purpose) const { return (*this)[index_of(purpose)]; }
  const std::vector<int>& margin_samples() const { return model_->margin_samples(); }

  /// Requests the k-th state, at `sample` if that is not 0; returns the place for the state near
  /// it.
  FoldState<double>& request(int k, int sample, double pilot_deg);
  /// Requests the state again, with the pilot at `pilot_deg`.
  void move_pilot(Purpose purpose, double pilot_deg);
  /// Exchanges the states at D and before D.
  void swap_d_with_before();
  /// Fills states that were not requested with that at D.
  void fill();

 private:
  const Model* model_ = nullptr;
  std::vector<RequestedState> states_;
};

}  // namespace misalign::solver
