// What the rejection tests do as a method of the study: from the base folding straight to the level
// that it has at a sample, and from there to the sample with the pilot held. Each sample by itself,
// without those before it; as many sheets side by side as a register has lanes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/lanes/level_solver.hpp"
#include "tests/bench/work_precision/problem.hpp"

namespace misalign::bench {

/// The problem's sheets as shifts of a model, and the places of its samples. Compiled once, for
/// every machine.
class LevelProblem {
 public:
  LevelProblem(const Problem& problem, const Demand& demand);

  const solver::Model& model() const { return model_; }
  const std::vector<solver::TestPlace>& places() const { return places_; }
  const solver::ShiftBlock& sheets() const { return sheets_; }

 private:
  const solver::Model model_;
  std::vector<solver::TestPlace> places_;
  solver::ShiftBlock sheets_;
};

template <class T>
class LevelJumps {
 public:
  LevelJumps(const Problem& problem, const Demand& demand)
      : problem_(problem, demand), solver_(problem_.model(), problem_.places()) {}

  void follow(std::vector<Track>& tracks) {
    const int sheets = problem_.sheets().sheets, width = solver::kLanes<T>;
    for (int first = 0; first < sheets; first += width) {
      const int count = std::min(width, sheets - first);
      solver_.load(problem_.sheets(), first, count);
      for (int i = 0; i < count; ++i) tracks[first + i] = {true, {}, {}};
      for (int place = 0; place < std::ssize(problem_.places()); ++place) {
        jump(place);
        for (int i = 0; i < count; ++i) keep(i, tracks[first + i]);
      }
    }
  }

 private:
  using Real = solver::Scalar<T>;

  // To the level, and along the tangent to the sample.
  void jump(int place) {
    using std::sqrt;
    solver_.solve(place);
    for (int i = 0; i < solver::kLanes<T>; ++i) is_there_[i] = bool(solver_.length_error(place, i));
    state_ = solver_.state();
    tangent_ = solver_.tangent();
    T square(0);
    for (const T& rate : tangent_) square = square + rate * rate;
    for (T& rate : tangent_) rate = rate / sqrt(square);
    const double pilot_deg = problem_.places()[place].pilot_deg;
    const auto at = solver::half_angle_of_deg(pilot_deg);
    const solver::HalfAngle<T>& pilot = state_.creases[problem_.model().mechanism().pilot];
    T way(0);
    for (int i = 0; i < solver::kLanes<T>; ++i) {
      const solver::HalfAngle<double> here{solver::lane(pilot.c, i), solver::lane(pilot.s, i)};
      const double rest_deg = pilot_deg - solver::angle_deg(here);
      solver::lane(way, i) =
          static_cast<Real>(rest_deg * solver::kRadPerDeg) / solver::lane(tangent_.back(), i);
    }
    solver_.solve_ahead(state_, tangent_, way,
                        {T(static_cast<Real>(at.c)), T(static_cast<Real>(at.s))}, place);
  }

  // One step by the base folding's factors, two corrections at the level, three at the sample.
  void keep(int i, Track& track) {
    constexpr int kCorrections = 6;
    track.converged = track.converged && is_there_[i];
    track.effort.corrections += kCorrections;
    track.effort.evaluations += kCorrections;
    for (const T& length : solver_.lengths()) track.lengths.push_back(solver::lane(length, i));
  }

  const LevelProblem problem_;
  solver::LevelSolver<T> solver_;
  solver::FoldState<T> state_;
  std::vector<T> tangent_;
  std::array<bool, solver::kLanes<T>> is_there_{};
};

Run levels_one_by_one(const Problem& problem, const Demand& demand);
Run levels_in_single_precision(const Problem& problem, const Demand& demand);
#ifdef MISALIGN_X86
Run levels_in_lanes(const Problem& problem, const Demand& demand);
#endif

}  // namespace misalign::bench
