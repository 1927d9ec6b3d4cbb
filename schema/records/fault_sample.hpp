// Defines the fault sample: which draws have a row, and how many draws a row stands for.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "schema/campaign/draw_range.hpp"

namespace misalign::schema {

/// Since this schema version, older than release 1.0.0, rows are rarer for larger draw numbers.
/// Units whose run had an older schema keep rows every 1024 draws.
inline constexpr int kRarerSampleSince = 4;

/// Least number of draws between neighbouring rows.
inline constexpr std::uint64_t kFaultSampleEvery = 1024;

/// Draw d has a row if it is a multiple of 2^k: k = 10 for d < 2^27; k = 11 for 2^27 <= d < 2^28,
/// and one more for each doubling, that is k = m - 16 for 2^m <= d < 2^(m + 1). The first 2^27
/// draws thus have 131,072 rows and each doubling beyond 65,536 more: 10^12 draws have about a
/// million. A row stands for 2^k draws, its own and those after it: with this weight, the inverse
/// of the sampled share, averages over rows are unbiased averages over draws.
class FaultSampleRule {
 public:
  /// Makes the rule of units whose run had this schema version.
  explicit constexpr FaultSampleRule(int schema_version = kRarerSampleSince)
      : gets_rarer_(schema_version >= kRarerSampleSince) {}

  /// Returns 2^k at this draw.
  constexpr std::uint64_t spacing(std::uint64_t draw) const {
    return std::uint64_t{1} << (gets_rarer_
                                    ? std::max(10, static_cast<int>(std::bit_width(draw)) - 17)
                                    : 10);
  }
  constexpr bool holds(std::uint64_t draw) const { return (draw & (spacing(draw) - 1)) == 0; }

  /// Returns the number of draws below `end` that have a row.
  std::uint64_t rows_below(std::uint64_t end) const;
  std::uint64_t rows_in(const DrawRange& range) const {
    return rows_below(range.hi) - rows_below(range.lo);
  }

 private:
  bool gets_rarer_;
};

}  // namespace misalign::schema
