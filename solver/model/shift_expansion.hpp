// The diagonals as an expansion in the shifts, to second order, from tables. With ternary shifts a
// vertex has nine places. What its place adds to a quantity, and what the places of two vertices
// add together, are numbers known beforehand, so a draw costs one addition for each pair of
// vertices: no residual, no solve. Quantities are each diagonal's elongation at an early angle and
// its slope at a late one, where the orders of the shifts still fall off quickly. On the base
// folding both vanish. What is left out is bounded by a multiple of the draw's own second order,
// and that multiple is measured on sheets of its own.
#pragma once

#include <cstdint>
#include <vector>
#include <xsimd/xsimd.hpp>  // its allocator; xsimd 13 has no header for that alone

#include "solver/model/model.hpp"

namespace misalign::solver {

/// Elongations at the early angle, slopes at the late one.
enum class ShiftedQuantity { elongation, slope };

/// The samples of the two angles, for this one of the far test. At 120 degrees of its 150 the
/// orders beyond the second are a hundredth of the slopes, at 140 five; at 15 all diagonals have
/// set out.
int early_sample(int far_sample);
int late_sample(int far_sample);

/// The angles at which an expansion is made ready: early, on both sides of the late one, late.
struct ShiftAngles {
  enum { kEarly, kBefore, kAfter, kLate };
  /// Slopes by central differences of lengths: their error is a ten-thousandth.
  static constexpr double kHalfStep_deg = 0.5;

  ShiftAngles(const Model& model, int early_sample, int late_sample);
  ~ShiftAngles();

  std::vector<TestAngle> all;
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

/// Sheets with drawn shifts, and what their quantities are (panel widths; per radian), where that
/// could be found.
struct ShiftSample {
  ShiftSample(const Model& model, int sheets);
  ~ShiftSample();

  ShiftBlock block;
  std::vector<double> elongations, slopes;  ///< sheet by sheet
  std::vector<char> is_known;
};

class ShiftExpansion {
 public:
  using Short = std::int16_t;
  /// Quantities of this many diagonals lie side by side: their elongations, then their slopes.
  static constexpr int kDiagonals = 16;
  static constexpr int kRow = 2 * kDiagonals;
  static constexpr int kPlaces = 9;

  explicit ShiftExpansion(const ShiftGradients& gradients);
  ~ShiftExpansion();
  /// Of its tables.
  static std::size_t bytes(int vertices, int diagonals);

  int vertices() const { return vertices_; }
  int groups() const { return groups_; }
  /// Shorts that a sheet's sums take: of each group the first order, then the second.
  std::size_t sums() const { return static_cast<std::size_t>(groups_) * 2 * kRow; }
  /// What a vertex in this place adds: to the first order, then to the second.
  const Short* single(int group, int vertex, int place) const {
    return singles_.data() + at_single(group, vertex, place);
  }
  /// What it adds to the second order together with the next vertex, and each one after that: of
  /// each, one row for each of its places.
  const Short* pair(int group, int vertex, int place) const {
    return pairs_.data() + at_pair(group, vertex, place);
  }
  /// The place of a vertex with shifts of these signs: -1, 0 or 1.
  static int place_of(int x, int y) { return 3 * (x + 1) + y + 1; }

  /// Measures the bounds on these sheets, of which the sums are known.
  void calibrate(const std::vector<Short>& sums, const ShiftSample& sample);
  /// A quantity of a sheet with these sums, and how far it may be off at most.
  struct Estimate {
    double value, bound;
  };
  Estimate estimate(ShiftedQuantity quantity, int diagonal, const Short* sums) const;
  /// What is certain of a sheet with these sums: `directions` becomes 1 where a diagonal grows
  /// somewhere, -1 where it shrinks, 0 where neither is certain. True if one does both.
  bool see(const Short* sums, signed char* directions) const;

 private:
  // Of one kind of quantity, padded to whole groups.
  struct Kind {
    std::vector<float> unit;   // of a short
    std::vector<float> share;  // of the second order that may be left out
    float least = 0;           // the second order is taken to be no smaller
  };
  std::size_t pairs_before(int vertex) const {
    return static_cast<std::size_t>(vertex) * (2 * vertices_ - vertex - 1) / 2;
  }
  std::size_t at_single(int group, int vertex, int place) const {
    const std::size_t before = static_cast<std::size_t>(group) * vertices_ + vertex;
    return (before * kPlaces + place) * 2 * kRow;
  }
  std::size_t at_pair(int group, int vertex, int place) const {
    const std::size_t pairs = group * pairs_before(vertices_) + pairs_before(vertex);
    const std::size_t after = static_cast<std::size_t>(vertices_ - 1 - vertex);
    return (pairs * kPlaces + place * after) * kPlaces * kRow;
  }
  void fill(ShiftedQuantity quantity, const ShiftGradients& gradients);
  /// Largest second order of a kind.
  float second_order(int kind, const Short* sums) const;

  const int vertices_, diagonals_, groups_;
  std::vector<Short, xsimd::aligned_allocator<Short, 64>> singles_, pairs_;
  Kind kinds_[2];
};

}  // namespace misalign::solver
