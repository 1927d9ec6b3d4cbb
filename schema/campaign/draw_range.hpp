#pragma once

#include <cstdint>

namespace misalign::schema {

/// Largest seed, 2^63 - 1, and end of the draws: a half-open range holds all but the last.
inline constexpr std::uint64_t kEndOfDraws = (1ULL << 63) - 1;

/// Half-open range of draw numbers.
struct DrawRange {
  std::uint64_t lo, hi;
  std::uint64_t size() const { return hi - lo; }
  friend bool operator==(const DrawRange&, const DrawRange&) = default;
};

}  // namespace misalign::schema
