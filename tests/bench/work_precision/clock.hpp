// Elapsed time and medians.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace misalign::bench {

/// Microseconds that `work` takes.
template <class Work>
double elapsed_us(Work&& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
      .count();
}

/// Microseconds that one call of `work` takes, from as many as fill a millisecond.
template <class Work>
double elapsed_each_us(Work&& work) {
  for (int calls = 1;; calls *= 2) {
    const double us = elapsed_us([&] {
      for (int call = 0; call < calls; ++call) work();
    });
    if (us > 1000) return us / calls;
  }
}

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

}  // namespace misalign::bench
