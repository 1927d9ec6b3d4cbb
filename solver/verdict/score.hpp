// A continuous score for splitting: D plus the fraction of a sample by which the first fault was
// missed.
#pragma once

#include <algorithm>
#include <cmath>

namespace misalign::solver {

/// A score counts in these shares of a sample: {score >= kScoresPerSample * d} are the sheets whose
/// samples are in order up to d.
inline constexpr int kScoresPerSample = 1024;
/// Of a sheet of which nothing is known: in no level.
inline constexpr int kNoScore = -1;

/// The part of a sample by which a fault was missed, on [0, 1), as whole scores.
inline int scores_of(double part) {
  const double scores = std::floor(part * kScoresPerSample);
  return static_cast<int>(std::clamp(scores, 0.0, kScoresPerSample - 1.0));
}

/// The least of several parts, each known to within its error.
class LeastPart {
 public:
  void add(double part, double error = 0) {
    low_ = std::min(low_, part - error);
    high_ = std::min(high_, part + error);
    least_ = std::min(least_, part);
  }
  double value() const { return least_; }
  /// Whether its whole scores are certain.
  bool is_certain() const { return scores_of(low_) == scores_of(high_); }

 private:
  double low_ = 1, high_ = 1, least_ = 1;
};

/// A diagonal goes on by `forward` in the sample before the fault and back by `back` > 0 in that of
/// the fault. A parabola through its three lengths turns at this part of a sample from half a
/// sample before D on. Where going back between samples is a fault too, parts count from D on, half
/// a sample later: the turn itself.
inline double turning_part(double forward, double back) {
  return forward > 0 ? forward / (forward + back) : 0;
}
/// Bound of its change, when each of the two steps is known to within `error`.
inline double turning_part_error(double forward, double back, double error) {
  return error / (std::max(forward, 0.0) + back);
}

/// The sine or cosine of half a crease's angle lies beyond its bound by `excess` >= 0: halved by as
/// much as a crease that follows the pilot turns in one sample.
inline double excess_part(double excess, double sample_rad) {
  const double turn = std::sin(sample_rad / 2);
  return turn / (turn + excess);
}

}  // namespace misalign::solver
