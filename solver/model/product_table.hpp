// Holds quadratic forms of the coordinates' signs as a table of bytes.
#pragma once

#include <cstdint>
#include <vector>
#include <xsimd/xsimd.hpp>  // for its allocator, which has no header of its own in xsimd 13

namespace misalign::solver {

/// The second order of all quantities as quadratic forms of the coordinates. Entries are bytes,
/// which processors multiply and sum in parallel.
struct ProductTable {
  using Byte = signed char;
  /// Number of products that one instruction sums.
  static constexpr int kQuad = 4;
  /// Signs of a sheet's coordinates are followed by this many zeros, so that they can be read a
  /// register at once.
  static constexpr int kPadding = 64;
  /// Largest number of coordinates with products.
  static constexpr int kMostCoordinates = 768;
  /// Number of quantities of a group, whose forms are adjacent.
  static constexpr int kRow = 16;

  explicit ProductTable(int count) : coordinates(count) {}

  const int coordinates;
  /// Four entries for each quantity: group by group, in each coordinate i by coordinate, in each
  /// four by four of the coordinates i, i + 1, ..., in each quantity by quantity of the group.
  /// Beyond the last coordinate: 0.
  std::vector<Byte, xsimd::aligned_allocator<Byte, 64>> entries;
  /// The sum of all entries for each quantity of each group.
  std::vector<std::int32_t> totals;

  /// Quads for `count` products; quads for a coordinate's products with itself and later ones.
  static int quads(int count) { return (count + kQuad - 1) / kQuad; }
  int quads_from(int coordinate) const { return quads(coordinates - coordinate); }
  int all_quads() const;
};

}  // namespace misalign::solver
