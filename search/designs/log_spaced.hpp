// Spaces values evenly in the logarithm.
#pragma once

#include <cmath>
#include <vector>

namespace misalign::search {

/// Two or more positive values from `first` to `last`, both among them.
inline std::vector<double> log_spaced(double first, double last, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) {
    values.push_back(first * std::pow(last / first, static_cast<double>(k) / (count - 1)));
  }
  return values;
}

}  // namespace misalign::search
