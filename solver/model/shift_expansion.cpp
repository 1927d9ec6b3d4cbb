#include "solver/model/shift_expansion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>

namespace misalign::solver {
namespace {

// The largest sum there can be is this many units; a pair's rounding is half a unit.
constexpr double kLargestSum = 32000;
constexpr double kLargestByte = 127;
// Of the largest share that was left out on the sheets that were measured. Among 30,000 sheets of
// 6 x 6 the largest is 1.6 times that of all but one in a thousand.
constexpr float kSafety = 4;
// No diagonal's share is taken to be less than this part of the largest: it was luck.
constexpr float kLeastShare = 0.5F;

// The second order of a sheet counts as at least this part of the median's: where it is small by
// accident, what is left out is not.
constexpr float kLeastOrder = 0.5F;

// Shifts of a vertex in its place, in amplitudes.
struct TernaryShift {
  explicit TernaryShift(int place) : x(place / 3 - 1), y(place % 3 - 1) {}  // NOLINT: whole
  double x, y;
};

ShiftExpansion::Short rounded(double value, double unit) {
  assert(std::abs(value) <= 32767 * unit);  // the bound of all sums fits
  return static_cast<ShiftExpansion::Short>(std::lround(value / unit));
}

}  // namespace

// One quantity as a polynomial in the levels of all coordinates.
class ShiftExpansion::Polynomial {
 public:
  Polynomial(const ShiftGradients& gradients, ShiftedQuantity quantity, int diagonal)
      : g_(gradients), q_(quantity), d_(diagonal) {}

  /// Alone: the mean of its slope over the step, by Simpson's rule, and what is even.
  double odd(int i) const { return (forth(i, i) + back(i, i) + 4 * g_.none(q_, d_, i)) / 6; }
  double even(int i) const { return (forth(i, i) - back(i, i)) / 4; }
  /// Of two coordinates: x_i x_j, and what the third order has of two only, x_i^2 x_j.
  double mixed(int i, int j) const {
    return (forth(i, j) - back(i, j) + forth(j, i) - back(j, i)) / 4;
  }
  double squared(int i, int j) const { return (forth(i, j) + back(i, j)) / 2 - g_.none(q_, d_, j); }

  double first(int vertex, const TernaryShift& at) const {
    return odd(2 * vertex) * at.x + odd(2 * vertex + 1) * at.y;
  }
  double second(int vertex, const TernaryShift& at) const {
    return even(2 * vertex) * at.x * at.x + even(2 * vertex + 1) * at.y * at.y +
           of_two(2 * vertex, at.x, 2 * vertex + 1, at.y);
  }
  double of_vertices(int g, const TernaryShift& at_g, int h, const TernaryShift& at_h) const {
    return of_two(2 * g, at_g.x, 2 * h, at_h.x) + of_two(2 * g, at_g.x, 2 * h + 1, at_h.y) +
           of_two(2 * g + 1, at_g.y, 2 * h, at_h.x) + of_two(2 * g + 1, at_g.y, 2 * h + 1, at_h.y);
  }
  /// Of the product of two coordinates, or of the square of one.
  double of_product(int i, int j) const { return i == j ? even(i) : mixed(i, j); }
  /// No sum is larger.
  double bound() const {
    double sum = 0;
    for (int i = 0; i < g_.coordinates(); ++i) {
      sum += std::abs(odd(i)) + std::abs(even(i));
      for (int j = 0; j < i; ++j) {
        sum += std::abs(mixed(i, j)) + std::abs(squared(i, j)) + std::abs(squared(j, i));
      }
    }
    return sum;
  }

 private:
  double forth(int i, int j) const { return g_.forth(q_, d_, i, j); }
  double back(int i, int j) const { return g_.back(q_, d_, i, j); }
  double of_two(int i, double x, int j, double y) const {
    return mixed(i, j) * x * y + squared(i, j) * x * x * y + squared(j, i) * y * y * x;
  }

  const ShiftGradients& g_;
  const ShiftedQuantity q_;
  const int d_;
};

ShiftPlaces::ShiftPlaces(const Model& model, double early_deg, double late_deg) {
  for (const double deg :
       {early_deg, late_deg - kHalfStep_deg, late_deg + kHalfStep_deg, late_deg}) {
    all.push_back(model.test_at(deg));
  }
}

ShiftPlaces::~ShiftPlaces() = default;

ShiftGradients::ShiftGradients(const Model& model)
    : coordinates_(static_cast<int>(2 * model.shifted().size())),
      diagonals_(model.mechanism().diagonal_count()) {
  const std::size_t count = static_cast<std::size_t>(coordinates_);
  sheets_.sheets = 1 + 2 * coordinates_;
  sheets_.shifts_mm.assign((1 + 2 * count) * count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    sheets_.shifts_mm[(1 + 2 * i) * count + i] = model.ternary_mm();
    sheets_.shifts_mm[(2 + 2 * i) * count + i] = -model.ternary_mm();
  }
  values_.assign(2 * static_cast<std::size_t>(diagonals_) * sheets_.shifts_mm.size(), 0);
}

ShiftGradients::~ShiftGradients() = default;

std::size_t ShiftGradients::place(ShiftedQuantity quantity, int diagonal, int sheet,
                                  int coordinate) const {
  const std::size_t row =
      static_cast<std::size_t>(static_cast<int>(quantity) * diagonals_ + diagonal);
  return (row * static_cast<std::size_t>(sheets_.sheets) + static_cast<std::size_t>(sheet)) *
             static_cast<std::size_t>(coordinates_) +
         static_cast<std::size_t>(coordinate);
}

void ShiftGradients::add(ShiftedQuantity quantity, int diagonal, int sheet, int coordinate,
                         double value) {
  assert(diagonal < diagonals_ && sheet < sheets_.sheets && coordinate < coordinates_);
  values_[place(quantity, diagonal, sheet, coordinate)] += value;
}

ShiftSample::ShiftSample(const Model& model, int sheets) {
  std::mt19937 words;
  block.sheets = sheets;
  block.shifts_mm.resize(static_cast<std::size_t>(sheets) * 2 * model.shifted().size());
  for (double& shift_mm : block.shifts_mm) {
    shift_mm = (static_cast<double>(words() % 3) - 1) * model.ternary_mm();
  }
  elongations.resize(static_cast<std::size_t>(sheets) * model.mechanism().diagonals.size());
  slopes.resize(elongations.size());
  is_known.assign(static_cast<std::size_t>(sheets), 0);
}

ShiftSample::~ShiftSample() = default;

int ProductTable::all_quads() const {
  int all = 0;
  for (int i = 0; i < coordinates; ++i) all += quads(i);
  return all;
}

ShiftExpansion::ShiftExpansion(const ShiftGradients& gradients, SecondOrder form)
    : form_(form),
      vertices_(gradients.coordinates() / 2),
      diagonals_(gradients.diagonals()),
      groups_((diagonals_ + kDiagonals - 1) / kDiagonals),
      singles_(static_cast<std::size_t>(groups_ * vertices_) * kPlaces * kSums),
      products_(gradients.coordinates()) {
  const std::size_t size = bytes(form, vertices_, diagonals_);
  if (form == SecondOrder::by_pairs) {
    pairs_.resize(size / sizeof(Short));
  } else {
    products_.entries.resize(size);
    products_.totals.resize(static_cast<std::size_t>(groups_) * kRow);
  }
  for (const ShiftedQuantity quantity : {ShiftedQuantity::elongation, ShiftedQuantity::slope}) {
    Kind& kind = kinds_[static_cast<int>(quantity)];
    kind.unit.assign(static_cast<std::size_t>(groups_ * kDiagonals), 0);
    kind.share = kind.second_unit = kind.unit;
    kind.least.assign(static_cast<std::size_t>(groups_), 0);
    for (int d = 0; d < diagonals_; ++d) fill(quantity, d, {gradients, quantity, d});
  }
}

ShiftExpansion::~ShiftExpansion() = default;

std::size_t ShiftExpansion::bytes(SecondOrder form, int vertices, int diagonals) {
  const std::size_t groups = static_cast<std::size_t>((diagonals + kDiagonals - 1) / kDiagonals);
  const std::size_t pairs = static_cast<std::size_t>(vertices) * (vertices - 1) / 2;
  if (form == SecondOrder::by_pairs) {
    return groups * pairs * kPlaces * kPlaces * kRow * sizeof(Short);
  }
  const std::size_t quads = static_cast<std::size_t>(ProductTable(2 * vertices).all_quads());
  return groups * quads * ProductTable::kQuad * kRow;
}

void ShiftExpansion::fill(ShiftedQuantity quantity, int diagonal, const Polynomial& q) {
  Kind& kind = kinds_[static_cast<int>(quantity)];
  const double unit = q.bound() / kLargestSum;
  const std::size_t d = static_cast<std::size_t>(diagonal);
  kind.unit[d] = kind.second_unit[d] = static_cast<float>(unit);
  if (form_ == SecondOrder::by_products) {
    kind.second_unit[d] = static_cast<float>(fill_products(quantity, diagonal, q));
  }
  const int group = diagonal / kDiagonals;
  const int column = static_cast<int>(quantity) * kDiagonals + diagonal % kDiagonals;
  for (int g = 0; g < vertices_; ++g) {
    for (int place = 0; place < kPlaces; ++place) {
      const TernaryShift at(place);
      Short* row = singles_.data() + at_single(group, g, place) + column;
      row[0] = rounded(q.first(g, at), unit);
      if (form_ == SecondOrder::by_products) continue;
      row[kRow] = rounded(q.second(g, at), unit);
      row = pairs_.data() + at_pair(group, g, place) + column;
      for (int h = g + 1; h < vertices_; ++h) {
        for (int other = 0; other < kPlaces; ++other, row += kRow) {
          *row = rounded(q.of_vertices(g, at, h, TernaryShift(other)), unit);
        }
      }
    }
  }
}

// Returns their unit: the largest entry fits, and every sum.
double ShiftExpansion::fill_products(ShiftedQuantity quantity, int diagonal, const Polynomial& q) {
  const int coordinates = products_.coordinates;
  double largest = 0;
  for (int i = 0; i < coordinates; ++i) {
    for (int j = i; j < coordinates; ++j) {
      largest = std::max(largest, std::abs(q.of_product(i, j)));
    }
  }
  const double unit = std::max(largest / kLargestByte, q.bound() / kLargestSum);
  const std::size_t group = static_cast<std::size_t>(diagonal / kDiagonals);
  const std::size_t column =
      static_cast<std::size_t>(static_cast<int>(quantity) * kDiagonals + diagonal % kDiagonals);
  std::int32_t& total = products_.totals[group * kRow + column];
  ProductTable::Byte* quad = products_.entries.data() +
                             products_.entries.size() / static_cast<std::size_t>(groups_) * group +
                             ProductTable::kQuad * column;
  for (int i = 0; i < coordinates; ++i) {
    for (int j = i; j < coordinates; ++j) {
      ProductTable::Byte& entry = quad[(j - i) / ProductTable::kQuad * ProductTable::kQuad * kRow +
                                       (j - i) % ProductTable::kQuad];
      entry = static_cast<ProductTable::Byte>(std::lround(q.of_product(i, j) / unit));
      total += entry;
    }
    quad += products_.quads(i) * ProductTable::kQuad * kRow;
  }
  return unit;
}

void ShiftExpansion::calibrate(int group, const std::vector<Short>& sums,
                               const ShiftSample& sample) {
  const std::size_t sheets = sample.is_known.size();
  assert(sums.size() >= sheets * kSums);
  assert(sample.slopes.size() == sheets * static_cast<std::size_t>(diagonals_));
  for (const ShiftedQuantity quantity : {ShiftedQuantity::elongation, ShiftedQuantity::slope}) {
    const int which = static_cast<int>(quantity);
    const std::vector<double>& truth = which == 0 ? sample.elongations : sample.slopes;
    Kind& of = kinds_[which];
    std::vector<float> orders(sheets);
    for (std::size_t s = 0; s < sheets; ++s) {
      orders[s] = second_order(which, group, sums.data() + s * kSums);
    }
    std::vector<float> sorted = orders;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sheets / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const float least = of.least[static_cast<std::size_t>(group)] = kLeastOrder * *middle;
    float* const share = of.share.data() + group * kDiagonals;
    const int count = diagonals_of(group);
    for (std::size_t s = 0; s < sheets; ++s) {
      for (int k = 0; k < count && sample.is_known[s]; ++k) {
        const int d = group * kDiagonals + k;
        const double known = estimate(quantity, d, sums.data() + s * kSums).value;
        const double left = std::abs(
            truth[s * static_cast<std::size_t>(diagonals_) + static_cast<std::size_t>(d)] - known);
        share[k] = std::max(share[k], static_cast<float>(left) / std::max(orders[s], least));
      }
    }
    const float largest = *std::max_element(share, share + count);
    for (int k = 0; k < count; ++k) {
      share[k] = kSafety * std::max(share[k], kLeastShare * largest);
    }
  }
}

ShiftExpansion::Estimate ShiftExpansion::estimate(ShiftedQuantity quantity, int diagonal,
                                                  const Short* sums) const {
  assert(diagonal >= 0 && diagonal < diagonals_);
  const int which = static_cast<int>(quantity);
  const Kind& kind = kinds_[which];
  const std::size_t d = static_cast<std::size_t>(diagonal);
  const Short* const first = sums + which * kDiagonals + diagonal % kDiagonals;
  return {first[0] * static_cast<double>(kind.unit[d]) +
              first[kRow] * static_cast<double>(kind.second_unit[d]),
          static_cast<double>(kind.share[d]) *
              static_cast<double>(second_order(which, diagonal / kDiagonals, sums))};
}

}  // namespace misalign::solver
