// The rule of the fault sample: which draws have a row, and how many draws such a row stands for.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "schema/campaign/draw_range.hpp"

namespace misalign::schema {

/// Since this version of the schema, older than release 1.0.0, rows are the rarer the larger the
/// draw's number. Rows of units whose run had an older schema are every 1024 draws, however large,
/// and stay.
inline constexpr int kRarerSampleSince = 4;

/// The least number of draws from one row to the next.
inline constexpr std::uint64_t kFaultSampleEvery = 1024;

/// Draw d has a row when it is a multiple of 2^k: k = 10 for d < 2^27; k = 11 for 2^27 <= d < 2^28,
/// and one more for each doubling, that is k = m - 16 for 2^m <= d < 2^(m + 1). So the first 2^27
/// draws have 131,072 rows and each doubling beyond 65,536 more: 10^12 draws have about a million.
/// A row stands for 2^k draws, its own and those after it: the inverse of the share that is kept,
/// the weight by which an average over rows is one over draws, without bias.
class FaultSampleRule {
 public:
  /// The rule of units whose run had this version of the schema.
  explicit constexpr FaultSampleRule(int schema_version = kRarerSampleSince)
      : gets_rarer_(schema_version >= kRarerSampleSince) {}

  /// 2^k at this draw.
  constexpr std::uint64_t spacing(std::uint64_t draw) const {
    return std::uint64_t{1} << (gets_rarer_
                                    ? std::max(10, static_cast<int>(std::bit_width(draw)) - 17)
                                    : 10);
  }
  constexpr bool holds(std::uint64_t draw) const { return (draw & (spacing(draw) - 1)) == 0; }

  /// How many draws below `end` have a row.
  std::uint64_t rows_below(std::uint64_t end) const;
  std::uint64_t rows_in(const DrawRange& range) const {
    return rows_below(range.hi) - rows_below(range.lo);
  }

 private:
  bool gets_rarer_;
};

}  // namespace misalign::schema
