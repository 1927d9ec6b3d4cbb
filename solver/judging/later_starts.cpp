#include "solver/judging/later_starts.hpp"

#include <algorithm>
#include <cassert>

#include "solver/continuation/step.hpp"

namespace misalign::solver {

LaterStarts::LaterStarts(const Model& model)
    : model_(model), near_(flat_state<double>(model.mechanism())) {}

LaterStarts::~LaterStarts() = default;

bool LaterStarts::reaches_back_to(const Station& station, const PathFunction& function) {
  const int oldest = std::min(function.kept(), kStateNodes) - 1;
  return station.pilot_deg * kRadPerDeg >= function.pilot(function.at(oldest));
}

FoldState<double>& LaterStarts::add(int sheet, std::size_t station, int forward_sign) {
  assert(station < model_.path().stations.size());
  if (starts_.size() == states_.size()) states_.push_back(near_);
  FoldState<double>& state = states_[starts_.size()];
  starts_.push_back({sheet, &state, &model_.path(), station, forward_sign});
  return state;
}

}  // namespace misalign::solver
