// Steps as long as Newton's start allows. Samples that a step passes over are interpolated, and
// corrected only where the interpolated state does not close within the tolerance.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "solver/kinematics/diagonals.hpp"
#include "tests/bench/work_precision/corrector.hpp"
#include "tests/bench/work_precision/predictor.hpp"

namespace misalign::bench {

struct AdaptiveOptions {
  Predictor predictor = Predictor::hermite;  ///< or tangent: then no sample is passed over
  double longest_step_deg = 20;
  double shortest_step_deg = 0.01;
  /// Sought size of the first correction, rad; a step is refused where it exceeds ten times that.
  double correction_rad = 0.02;
  /// Sought part of the tolerance by which interpolated states are open.
  double fill_part = 0.5;
  double largest_growth = 2;
};

template <class Linear>
class Adaptive {
 public:
  Adaptive(const Problem& problem, const Demand& demand, const AdaptiveOptions& options)
      : mechanism_(problem.mechanism()),
        options_(options),
        tolerance_(demand.tolerance),
        spacing_deg_(demand.spacing_deg),
        start_(problem.base_state(demand.spacing_deg)),
        corrector_(problem.topology(), demand.tolerance),
        state_(start_),
        step_(static_cast<std::size_t>(mechanism_.unknowns)),
        lengths_(mechanism_.diagonals.size()),
        last_{0, start_, step_},
        before_(last_) {}

  void follow(const Sheet& sheet, Track& track) {
    track.converged = false;
    track.effort = {};
    track.lengths.clear();
    // The first sample from the base folding.
    double at_deg = spacing_deg_;
    state_ = start_;
    if (!corrector_.correct(sheet.geometry, state_, track.effort)) return;
    accept(at_deg);
    record(sheet, track);
    corrector_.tangent(last_.tangent);
    double wanted_deg = spacing_deg_, taken_deg = 0;
    while (at_deg < kEnd_deg) {
      const double to_deg = next_station(at_deg, wanted_deg);
      const double step_deg = to_deg - at_deg;
      predict(to_deg, taken_deg > 0);
      if (!corrector_.correct(sheet.geometry, state_, track.effort) ||
          corrector_.first_correction() > 10 * options_.correction_rad) {
        wanted_deg = 0.5 * step_deg;
        if (wanted_deg < options_.shortest_step_deg) return;
        continue;
      }
      accept(to_deg);
      wanted_deg = next_step(step_deg, taken_deg, corrector_.first_correction());
      // A cubic that passes over samples is only as good as its tangents.
      if (std::max(step_deg, wanted_deg) > spacing_deg_) {
        corrector_.tangent_afresh(last_.tangent);
      } else {
        corrector_.tangent(last_.tangent);
      }
      open_by_ = 0;
      if (!fill(sheet, at_deg, to_deg, track)) return;
      if (open_by_ > 0) wanted_deg = std::min(wanted_deg, next_filled_step(step_deg));
      taken_deg = step_deg;
      at_deg = to_deg;
    }
    track.converged = true;
  }

 private:
  // The last sample within reach, or an equal part of the way to the next one.
  double next_station(double at_deg, double wanted_deg) const {
    const double reach =
        std::min(std::floor((at_deg + wanted_deg) / spacing_deg_ + 1e-9) * spacing_deg_,
                 static_cast<double>(kEnd_deg));
    if (reach > at_deg + 1e-9) return reach;
    const double rest_deg = (std::floor(at_deg / spacing_deg_ + 1e-9) + 1) * spacing_deg_ - at_deg;
    const double parts = std::ceil(rest_deg / wanted_deg - 1e-9);
    return parts <= 1 ? at_deg + rest_deg : at_deg + rest_deg / parts;
  }

  void predict(double to_deg, bool has_two_points) {
    const double to_rad = to_deg * solver::kRadPerDeg;
    if (options_.predictor == Predictor::hermite && has_two_points) {
      predict_by_cubic(mechanism_, before_, last_, to_rad, state_);
    } else {
      predict_along_tangent(mechanism_, last_, to_rad, step_, state_);
    }
    state_.creases[mechanism_.pilot] = solver::half_angle_of_deg(to_deg);
  }

  void accept(double at_deg) {
    std::swap(before_, last_);
    last_.pilot_rad = at_deg * solver::kRadPerDeg;
    last_.state = state_;
  }

  // Lengths at the samples after from_deg, up to to_deg if that is one.
  bool fill(const Sheet& sheet, double from_deg, double to_deg, Track& track) {
    const int first = static_cast<int>(std::floor(from_deg / spacing_deg_ + 1e-9)) + 1;
    const int last = static_cast<int>(std::floor(to_deg / spacing_deg_ + 1e-9));
    for (int k = first; k < last; ++k) {
      const double sample_deg = k * spacing_deg_;
      predict_by_cubic(mechanism_, before_, last_, sample_deg * solver::kRadPerDeg, state_);
      state_.creases[mechanism_.pilot] = solver::half_angle_of_deg(sample_deg);
      const double open = corrector_.open_by(sheet.geometry, state_, track.effort);
      open_by_ = std::max(open_by_, open);
      if (open > tolerance_ && !corrector_.correct(sheet.geometry, state_, track.effort)) {
        return false;
      }
      record(sheet, track);
    }
    if (last >= first) {
      state_ = last_.state;
      record(sheet, track);
    }
    return true;
  }

  void record(const Sheet& sheet, Track& track) {
    solver::folded_lengths(mechanism_, sheet.geometry, state_, lengths_.data());
    track.lengths.insert(track.lengths.end(), lengths_.begin(), lengths_.end());
  }

  // The prediction's error goes with the second (tangent) or fourth (cubic) power of the step. Of
  // two cubics over the same points, the one through both ends of a step h is off by h^4 / 384
  // times the fourth derivative, the one that went on by s from a step r by s^2 (r + s)^2 / 24
  // times it. Loops are open by a few times the joints' error.
  double next_step(double s, double r, double missed_rad) const {
    const bool cubic = options_.predictor == Predictor::hermite && r > 0;
    const double off = std::max(missed_rad, 1e-16);
    double next = s * std::pow(options_.correction_rad / off, cubic ? 0.25 : 0.5);
    if (!cubic) {
      next = std::min(next, spacing_deg_);
    } else {
      const double filled =
          std::pow(options_.fill_part * tolerance_ * 16 / (4 * off), 0.25) * std::sqrt(s * (r + s));
      next = std::min(next, whole_samples(filled));
    }
    return std::clamp(next, options_.shortest_step_deg,
                      std::min(options_.largest_growth * s, options_.longest_step_deg));
  }

  // The same from how far the states just interpolated were open.
  double next_filled_step(double s) const {
    return whole_samples(s * std::pow(options_.fill_part * tolerance_ / open_by_, 0.25));
  }

  // Passing over samples pays from two on.
  double whole_samples(double step_deg) const {
    return step_deg < 2 * spacing_deg_ ? spacing_deg_ : step_deg;
  }

  const solver::Mechanism& mechanism_;
  AdaptiveOptions options_;
  double tolerance_, spacing_deg_;
  solver::FoldState<double> start_;
  Corrector<double, Linear> corrector_;
  solver::FoldState<double> state_;
  std::vector<double> step_, lengths_;
  PathPoint<double> last_, before_;
  double open_by_ = 0;  // the worst of the states interpolated on the last step
};

}  // namespace misalign::bench
