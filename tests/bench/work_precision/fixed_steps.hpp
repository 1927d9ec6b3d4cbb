// Equal steps of the pilot, each corrected from a prediction.
#pragma once

#include <utility>
#include <vector>

#include "solver/kinematics/diagonals.hpp"
#include "tests/bench/work_precision/corrector.hpp"
#include "tests/bench/work_precision/predictor.hpp"

namespace misalign::bench {

struct FixedStepsOptions {
  double step_deg = 1;  ///< divides the samples' spacing
  Predictor predictor = Predictor::previous;
  JacobianBy jacobian = JacobianBy::analytic;
};

template <class T, class Linear>
class FixedSteps {
 public:
  FixedSteps(const Problem& problem, const Demand& demand, const FixedStepsOptions& options)
      : mechanism_(problem.mechanism()),
        options_(options),
        spacing_deg_(demand.spacing_deg),
        start_(state_as<T>(problem.base_state(options.step_deg))),
        corrector_(problem.topology(), demand.tolerance, options.jacobian),
        state_(start_),
        step_(static_cast<std::size_t>(mechanism_.unknowns)),
        lengths_(mechanism_.diagonals.size()),
        last_{T(0), start_, step_},
        before_(last_) {}

  void follow(const Sheet& sheet, Track& track) {
    const solver::SheetGeometry<T> geometry = geometry_as<T>(sheet.geometry);
    track.converged = false;
    track.effort = {};
    track.lengths.clear();
    const int steps = static_cast<int>(kEnd_deg / options_.step_deg + 0.5);
    const int steps_a_sample = static_cast<int>(spacing_deg_ / options_.step_deg + 0.5);
    for (int k = 1; k <= steps; ++k) {
      const double pilot_deg = k * options_.step_deg;
      const T pilot_rad = static_cast<T>(pilot_deg * solver::kRadPerDeg);
      predict(k, pilot_rad);
      state_.creases[mechanism_.pilot] = pilot_as<T>(pilot_deg);
      if (!corrector_.correct(geometry, state_, track.effort)) return;
      if (options_.predictor != Predictor::previous) {
        std::swap(before_, last_);
        last_.pilot_rad = pilot_rad;
        last_.state = state_;
        corrector_.tangent(last_.tangent);
      }
      if (k % steps_a_sample != 0) continue;
      solver::folded_lengths(mechanism_, geometry, state_, lengths_.data());
      track.lengths.insert(track.lengths.end(), lengths_.begin(), lengths_.end());
    }
    track.converged = true;
  }

 private:
  void predict(int k, T pilot_rad) {
    if (k == 1) {
      state_ = start_;
    } else if (options_.predictor == Predictor::tangent ||
               (options_.predictor == Predictor::hermite && k == 2)) {
      predict_along_tangent(mechanism_, last_, pilot_rad, step_, state_);
    } else if (options_.predictor == Predictor::hermite) {
      predict_by_cubic(mechanism_, before_, last_, pilot_rad, state_);
    }
  }

  const solver::Mechanism& mechanism_;
  FixedStepsOptions options_;
  int spacing_deg_;
  solver::FoldState<T> start_;
  Corrector<T, Linear> corrector_;
  solver::FoldState<T> state_;
  std::vector<T> step_, lengths_;
  PathPoint<T> last_, before_;
};

}  // namespace misalign::bench
