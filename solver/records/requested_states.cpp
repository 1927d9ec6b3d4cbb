#include "solver/records/requested_states.hpp"

#include <cassert>
#include <utility>

namespace misalign::solver {

SolvedStates::SolvedStates(const Model& model, int lanes) {
  const std::size_t diagonals = model.mechanism().diagonals.size();
  const SolvedState nothing{
      {0, 0, 0}, std::vector<double>(diagonals), std::vector<double>(diagonals)};
  of_lanes_.assign(static_cast<std::size_t>(lanes),
                   std::vector<SolvedState>(model.margin_samples().size() + kPurposes, nothing));
}

SolvedStates::~SolvedStates() = default;

void RequestedStates::begin(const Model& model) {
  model_ = &model;
  states_.clear();
  states_.resize(model.margin_samples().size() + kPurposes);
}

FoldState<double>& RequestedStates::request(int k, int sample, double pilot_deg) {
  assert(k >= 0 && k < count() && sample >= 0);
  RequestedState& state = states_[static_cast<std::size_t>(k)];
  state.sample = sample;
  state.pilot_deg = pilot_deg;
  state.pilot = half_angle_of_deg(pilot_deg);
  state.near.creases.resize(model_->mechanism().creases.size());
  state.near.balls.resize(model_->mechanism().balls.size());
  return state.near;
}

void RequestedStates::move_pilot(Purpose purpose, double pilot_deg) {
  states_[static_cast<std::size_t>(index_of(purpose))].pilot = half_angle_of_deg(pilot_deg);
}

void RequestedStates::swap_d_with_before() {
  std::swap(states_[static_cast<std::size_t>(index_of(Purpose::at_d))],
            states_[static_cast<std::size_t>(index_of(Purpose::before_d))]);
}

void RequestedStates::fill() {
  const RequestedState& at_d = of(Purpose::at_d);
  for (RequestedState& state : states_) {
    if (state.pilot_deg == 0) state = at_d;
  }
}

}  // namespace misalign::solver
