// The diagonals as an expansion in the shifts, to second order, from tables. With ternary shifts a
// vertex has nine places, and what its place adds to a quantity is known beforehand; so is what the
// product of two coordinates adds, which is -1, 0 or 1 times a number. No residual, no solve.
// Quantities are each diagonal's elongation at an early angle and
// its slope at a late one, where the orders of the shifts still fall off quickly. On the base
// folding both vanish. What is left out is bounded by a multiple of the draw's own second order,
// and that multiple is measured on sheets of its own.
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

/// Where quantities are looked at: early, on both sides of the late level, late.
struct ShiftPlaces {
  enum { kEarly, kBefore, kAfter, kLate };
  /// Slopes by central differences of lengths: their error is a ten-thousandth.
  static constexpr double kHalfStep_deg = 0.5;

  /// By the base folding's pilot.
  ShiftPlaces(const Model& model, double early_deg, double late_deg);
  ~ShiftPlaces();

  std::vector<TestPlace> all;
};

/// Gradients of all quantities by all coordinates (x and y of each shifted vertex in turn, in
/// amplitudes), of the sheets that an expansion is made from: without shifts (0), and with
/// coordinate i shifted forth (1 + 2 i) and back (2 + 2 i).
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
  /// Sheets with drawn shifts, and what their quantities are (panel widths; per radian), where that
  /// could be found.
  struct Sample {
    Sample(const Model& model, int sheets);
    ~Sample();

    ShiftBlock block;
    std::vector<double> elongations, slopes;  ///< sheet by sheet
    std::vector<char> is_known;
  };

  using Short = std::int16_t;
  /// A group: quantities of this many diagonals lie side by side, their elongations, then their
  /// slopes. Sheets that one group turns away need not be asked of the next.
  static constexpr int kRow = ProductTable::kRow, kDiagonals = kRow / 2;
  static constexpr int kPlaces = 9;
  /// Of a sheet and a group: the first order, then the second.
  static constexpr int kSums = 2 * kRow;

  explicit ShiftExpansion(const ShiftGradients& gradients);
  ~ShiftExpansion();
  /// Of its products.
  static std::size_t bytes(int vertices, int diagonals);

  int vertices() const { return vertices_; }
  int groups() const { return groups_; }
  int diagonals() const { return diagonals_; }
  /// Diagonals of a group: the last one may have fewer.
  int diagonals_of(int group) const {
    return std::min(kDiagonals, diagonals_ - group * kDiagonals);
  }
  /// The second order: what products are multiplied with.
  const ProductTable& products() const { return products_; }
  /// What a vertex in this place adds to the first order.
  const Short* single(int group, int vertex, int place) const {
    return singles_.data() + at_single(group, vertex, place);
  }
  /// The place of a vertex with shifts of these signs: -1, 0 or 1.
  static int place_of(int x, int y) { return 3 * (x + 1) + y + 1; }

  /// Measures the bounds of a group on these sheets, whose sums are known.
  void calibrate(int group, const std::vector<Short>& sums, const Sample& sample);
  /// A quantity of a sheet whose diagonal's group has these sums, and how far it may be off.
  struct Estimate {
    double value, bound;
  };
  Estimate estimate(ShiftedQuantity quantity, int diagonal, const Short* sums) const;
  /// What is certain of a group's diagonals in a sheet with these sums: `directions` becomes 1
  /// where one grows somewhere, -1 where it shrinks, 0 where neither is certain. True if one does
  /// both.
  bool see(int group, const Short* sums, signed char* directions) const;

 private:
  class Polynomial;
  // Of one kind of quantity, padded to whole groups.
  struct Kind {
    std::vector<float> unit, second_unit;  // of a short
    std::vector<float> share;              // of the second order that may be left out
    std::vector<float> least;              // of a group: the second order is taken to be no smaller
  };
  std::size_t at_single(int group, int vertex, int place) const {
    const std::size_t before = static_cast<std::size_t>(group) * vertices_ + vertex;
    return (before * kPlaces + place) * kRow;
  }
  // Of a quantity, whose column it is in its group. They return its unit: every entry fits, and
  // every sum.
  float fill_singles(int group, int column, const Polynomial& polynomial);
  float fill_products(int group, int column, const Polynomial& polynomial);
  /// Largest second order of a kind.
  float second_order(int kind, int group, const Short* sums) const;

  const int vertices_, diagonals_, groups_;
  std::vector<Short, xsimd::aligned_allocator<Short, 64>> singles_;
  ProductTable products_;
  Kind kinds_[2];
};

// Inlined, for the registers of whoever asks.
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
