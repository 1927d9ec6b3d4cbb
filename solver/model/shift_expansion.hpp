// Expands the diagonals in the shifts to second order, from tables, without residual or solve. With
// ternary shifts a vertex has nine places, each with a tabulated addition to a quantity; the
// product of two coordinates adds -1, 0 or 1 times a number. Quantities are each diagonal's
// elongation at an early angle and its slope at a late one, where the orders of the shifts still
// decrease fast; both vanish on the base folding. The remainder is bounded by a multiple of the
// draw's second order, which is measured on a sample of sheets.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/model/product_table.hpp"

namespace misalign::solver {

/// Elongations at the early angle, slopes at the late one.
enum class ShiftedQuantity { elongation, slope };

/// Places at which quantities are taken: early, on both sides of the late level, late.
struct ShiftPlaces {
  enum { kEarly, kBefore, kAfter, kLate };
  /// Half step of the central differences that give slopes, with an error of a ten-thousandth.
  static constexpr double kHalfStep_deg = 0.5;

  /// Angles are those of the base folding's pilot.
  ShiftPlaces(const Model& model, double early_deg, double late_deg);
  ~ShiftPlaces();

  std::vector<TestPlace> all;
};

/// Gradients of all quantities by all coordinates (x and y of each shifted vertex in turn, in
/// amplitudes), on the sheets from which an expansion is made: unshifted (0), and with coordinate i
/// shifted forth (1 + 2 i) and back (2 + 2 i).
class ShiftGradients {
 public:
  explicit ShiftGradients(const Model& model);
  ~ShiftGradients();

  const ShiftBlock& sheets() const { return sheets_; }
  int coordinates() const { return coordinates_; }
  int diagonals() const { return diagonals_; }
  /// Adds to a gradient.
  void add(ShiftedQuantity quantity, int diagonal, int sheet, int coordinate, double value);
  double forth(ShiftedQuantity q, int d, int i, int j) const { return at(q, d, 1 + 2 * i, j); }
  double back(ShiftedQuantity q, int d, int i, int j) const { return at(q, d, 2 + 2 * i, j); }
  double none(ShiftedQuantity q, int d, int j) const { return at(q, d, 0, j); }

 private:
  double at(ShiftedQuantity quantity, int diagonal, int sheet, int coordinate) const {
    return values_[place(quantity, diagonal, sheet, coordinate)];
  }
  std::size_t place(ShiftedQuantity quantity, int diagonal, int sheet, int coordinate) const;

  const int coordinates_, diagonals_;
  ShiftBlock sheets_;
  std::vector<double> values_;
};

class ShiftExpansion {
 public:
  /// Quantities of sheets with drawn shifts (panel widths; per radian), where they are known.
  struct Sample {
    Sample(const Model& model, int sheets);
    ~Sample();

    ShiftBlock block;
    std::vector<double> elongations, slopes;  ///< sheet by sheet
    std::vector<char> is_known;
  };

  using Short = std::int16_t;
  /// Sizes of a group: the elongations of kDiagonals diagonals, then their slopes. Sheets that one
  /// group rejects skip the next groups.
  static constexpr int kRow = ProductTable::kRow, kDiagonals = kRow / 2;
  static constexpr int kPlaces = 9;
  /// Sums of a sheet and a group: the first order, then the second.
  static constexpr int kSums = 2 * kRow;

  explicit ShiftExpansion(const ShiftGradients& gradients);
  ~ShiftExpansion();
  /// Size of the table of products.
  static std::size_t bytes(int vertices, int diagonals);

  int vertices() const { return vertices_; }
  int groups() const { return groups_; }
  int diagonals() const { return diagonals_; }
  /// Number of a group's diagonals; the last group may have fewer.
  int diagonals_of(int group) const {
    return std::min(kDiagonals, diagonals_ - group * kDiagonals);
  }
  /// Coefficients of the second order.
  const ProductTable& products() const { return products_; }
  /// First-order terms of a vertex in this place.
  const Short* single(int group, int vertex, int place) const {
    return singles_.data() + at_single(group, vertex, place);
  }
  /// Place of a vertex whose shifts have the signs x and y: -1, 0 or 1.
  static int place_of(int x, int y) { return 3 * (x + 1) + y + 1; }

  /// Measures a group's error bounds on sample sheets with these sums.
  void calibrate(int group, const std::vector<Short>& sums, const Sample& sample);
  /// A quantity of a sheet whose diagonal's group has these sums, and its error bound.
  struct Estimate {
    double value, bound;
  };
  Estimate estimate(ShiftedQuantity quantity, int diagonal, const Short* sums) const;
  /// Finds the certain directions of a group's diagonals on a sheet with these sums: 1 if a
  /// diagonal grows somewhere, -1 if it shrinks, 0 if neither is certain. Returns true if one does
  /// both.
  bool see(int group, const Short* sums, signed char* directions) const;

 private:
  class Polynomial;
  // Data of one kind of quantity, padded to whole groups.
  struct Kind {
    std::vector<float> unit, second_unit;  // value of a short's unit
    std::vector<float> share;              // remainder as a share of the second order
    std::vector<float> least;              // per group: lower bound of the second order
  };
  std::size_t at_single(int group, int vertex, int place) const {
    const std::size_t before = static_cast<std::size_t>(group) * vertices_ + vertex;
    return (before * kPlaces + place) * kRow;
  }
  // Fill the column of a quantity in its group; return its unit, with which every entry and sum
  // fits.
  float fill_singles(int group, int column, const Polynomial& polynomial);
  float fill_products(int group, int column, const Polynomial& polynomial);
  /// Largest second order of a kind.
  float second_order(int kind, int group, const Short* sums) const;

  const int vertices_, diagonals_, groups_;
  std::vector<Short, xsimd::aligned_allocator<Short, 64>> singles_;
  ProductTable products_;
  Kind kinds_[2];
};

// Inlined, so that it uses its callers' registers.
[[gnu::always_inline]] inline float ShiftExpansion::second_order(int kind, int group,
                                                                 const Short* sums) const {
  const float* const unit = kinds_[kind].second_unit.data() + group * kDiagonals;
  const Short* const second = sums + kRow + kind * kDiagonals;
  float largest = kinds_[kind].least[static_cast<std::size_t>(group)];
  for (int k = 0; k < kDiagonals; ++k) {
    largest = std::max(largest, std::abs(static_cast<float>(second[k]) * unit[k]));
  }
  return largest;
}

[[gnu::always_inline]] inline bool ShiftExpansion::see(int group, const Short* sums,
                                                       signed char* directions) const {
  int grows[kDiagonals] = {}, shrinks[kDiagonals] = {};
  for (int kind = 0; kind < 2; ++kind) {
    const float scale = second_order(kind, group, sums);
    const Short* const first = sums + kind * kDiagonals;
    const float* const unit = kinds_[kind].unit.data() + group * kDiagonals;
    const float* const second_unit = kinds_[kind].second_unit.data() + group * kDiagonals;
    const float* const share = kinds_[kind].share.data() + group * kDiagonals;
    for (int k = 0; k < kDiagonals; ++k) {
      const float value = static_cast<float>(first[k]) * unit[k] +
                          static_cast<float>(first[kRow + k]) * second_unit[k];
      const float bound = share[k] * scale;
      grows[k] |= value > bound;
      shrinks[k] |= value < -bound;
    }
  }
  int conflicts = 0;
  for (int k = 0; k < kDiagonals; ++k) conflicts |= grows[k] & shrinks[k];
  const int count = diagonals_of(group);
  for (int k = 0; k < count; ++k) {
    directions[k] = static_cast<signed char>(grows[k] - shrinks[k]);
  }
  return conflicts != 0;
}

}  // namespace misalign::solver
