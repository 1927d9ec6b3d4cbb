// Keeps a state of each sheet that rejection tests have not decided: the next step starts there.
#pragma once

#include <vector>

#include "solver/kinematics/fold_state.hpp"

namespace misalign::solver {

/// A sheet that is not decided yet, and the index of its kept state; -1: none can be trusted.
struct Undecided {
  int sheet, kept_state;
};

class KeptStates {
 public:
  /// A state on a sheet's path.
  struct State {
    FoldState<double> state;
    std::vector<double> tangent;  ///< one entry per unknown, unit length, away from flat
    double pilot_deg;
    double step_deg;  ///< next step of the base folding's pilot ...
    int to_sample;    ///< ... and exactly to this sample; 0: to none
    bool goes_on;     ///< true if states beyond may tell more
  };

  explicit KeptStates(const Mechanism& mechanism);
  ~KeptStates();

  /// Forgets all states.
  void begin() { count_ = 0; }
  /// Returns the state of this sheet, or room for it.
  State& of(Undecided& sheet);

 private:
  const Mechanism& mechanism_;
  std::vector<State> states_;  // grows with the blocks
  int count_ = 0;
};

}  // namespace misalign::solver
