#include "solver/lanes/kept_states.hpp"

#include <cassert>

namespace misalign::solver {

KeptStates::KeptStates(const Mechanism& mechanism) : mechanism_(mechanism) {}

KeptStates::~KeptStates() = default;

KeptStates::State& KeptStates::of(Undecided& sheet) {
  assert(sheet.kept_state < count_ && count_ <= std::ssize(states_));
  if (sheet.kept_state < 0) sheet.kept_state = count_++;
  if (sheet.kept_state == std::ssize(states_)) {
    states_.push_back({flat_state<double>(mechanism_),
                       std::vector<double>(static_cast<std::size_t>(mechanism_.unknowns)), 0, 0, 0,
                       false});
  }
  return states_[sheet.kept_state];
}

}  // namespace misalign::solver
