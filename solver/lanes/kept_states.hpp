// What the rejection tests keep of the sheets that they have not decided: a state to go on from.
#pragma once

#include <vector>

#include "solver/kinematics/fold_state.hpp"

namespace misalign::solver {

/// A sheet that is not decided yet, and its state kept; -1: none can be trusted.
struct Undecided {
  int sheet, kept_state;
};

class KeptStates {
 public:
  /// A state on a sheet's path.
  struct State {
    FoldState<double> state;
    std::vector<double> tangent;  ///< of unit length, one per unknown, away from flat
    double pilot_deg;
    double step_deg;  ///< by which to go on, of the base folding's pilot ...
    int to_sample;    ///< ... and exactly to this sample; 0: to none
    bool goes_on;     ///< whether states beyond may tell more
  };

  explicit KeptStates(const Mechanism& mechanism);
  ~KeptStates();

  /// Forgets them all.
  void begin() { count_ = 0; }
  /// The one of this sheet, or room for it.
  State& of(Undecided& sheet);

 private:
  const Mechanism& mechanism_;
  std::vector<State> states_;  // grows to what a block needs
  int count_ = 0;
};

}  // namespace misalign::solver
