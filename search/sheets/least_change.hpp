// The least change of a number that meets a requirement.
#pragma once

#include <functional>
#include <optional>

namespace misalign::search {

/// Returns whether a value meets the requirement, and a score that grows towards that.
struct Judged {
  bool passes;
  double score;
};
using Judge = std::function<Judged(double value)>;

/// Bounds of a number, and the factor of its first change: below 1 to decrease it.
struct ChangeLimits {
  double factor, least, most;
};

/// Changes a positive number that fails with `score` by up to four factors, until it passes or the
/// score falls, and bisects the last factor three times, in the logarithm. None: no such value.
std::optional<double> least_change(double start, double score, const ChangeLimits& limits,
                                   const Judge& judge);

/// Rounds a positive number to two digits, to the nearest, up or down; 0 stays.
enum class Rounding { nearest, up, down };
double two_digits(double value, Rounding rounding = Rounding::nearest);

}  // namespace misalign::search
