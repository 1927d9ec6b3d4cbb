// Defines a continuous score for splitting: D plus the fraction of a sample by which the first
// fault was missed.
#pragma once

#include <algorithm>
#include <cmath>

namespace misalign::solver {

/// Scores per sample: {score >= kScoresPerSample * d} are the sheets whose samples are in order up
/// to d.
inline constexpr int kScoresPerSample = 1024;
/// Score of an unknown sheet, which is in no level.
inline constexpr int kNoScore = -1;

/// The part of a sample by which a fault was missed, on [0, 1), as whole scores.
inline int scores_of(double part) {
  const double scores = std::floor(part * kScoresPerSample);
  return static_cast<int>(std::clamp(scores, 0.0, kScoresPerSample - 1.0));
}

/// The least of several parts, each with an error bound.
class LeastPart {
 public:
  void add(double part, double error = 0) {
    low_ = std::min(low_, part - error);
    high_ = std::min(high_, part + error);
    least_ = std::min(least_, part);
  }
  double value() const { return least_; }
  /// Returns whether its whole scores are certain.
  bool is_certain() const { return scores_of(low_) == scores_of(high_); }

 private:
  double low_ = 1, high_ = 1, least_ = 1;
};

/// A diagonal advances by `forward` in the sample before the fault and retreats by `back` > 0 in
/// that of the fault. The parabola through its three lengths turns at this part of a sample,
/// counted from half a sample before D. If retreats between samples are faults too, parts count
/// from D, half a sample later: the turn itself.
inline double turning_part(double forward, double back) {
  return forward > 0 ? forward / (forward + back) : 0;
}
/// Bound of the part's error if each of the two steps has an error up to `error`.
inline double turning_part_error(double forward, double back, double error) {
  return error / (std::max(forward, 0.0) + back);
}

/// Part for a crease whose half-angle sine or cosine exceeds its bound by `excess` >= 0. It is 1/2
/// at the excess by which a crease that follows the pilot turns in one sample.
inline double excess_part(double excess, double sample_rad) {
  const double turn = std::sin(sample_rad / 2);
  return turn / (turn + excess);
}

}  // namespace misalign::solver
