#include "solver/model/shift_expansion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>

namespace misalign::solver {
namespace {

// Largest possible sum and entry in units.
constexpr double kLargestSum = 32000;
constexpr double kLargestByte = 127;
// Safety factor of the largest remainder on the sample's sheets. Among 30,000 sheets of 6 x 6 the
// largest is 1.6 times that of all but one in a thousand.
constexpr float kSafety = 4;
// Lower bound of a diagonal's remainder as a share of the largest: smaller ones are chance.
constexpr float kLeastShare = 0.5F;

// Lower bound of a sheet's second order as a share of the median: if it is small by chance, the
// remainder is not.
constexpr float kLeastOrder = 0.5F;
// Mean square of a shift in squared amplitudes.
constexpr double kMeanSquare = 2.0 / 3;

}  // namespace

// One quantity as a polynomial in the shifts of all coordinates, in amplitudes.
class ShiftExpansion::Polynomial {
 public:
  Polynomial(const ShiftGradients& gradients, ShiftedQuantity quantity, int diagonal)
      : g_(gradients), q_(quantity), d_(diagonal) {}

  /// Coefficient of x_j: its mean slope over the step by Simpson's rule, plus the mean of the terms
  /// x_i^2 x_j.
  double linear(int j) const {
    const double none = g_.none(q_, d_, j);
    double sum = (forth(j, j) + back(j, j) + 4 * none) / 6;
    for (int i = 0; i < g_.coordinates(); ++i) {
      if (i != j) sum += kMeanSquare * ((forth(i, j) + back(i, j)) / 2 - none);
    }
    return sum;
  }
  /// Coefficient of x_i x_j.
  double product(int i, int j) const {
    return (forth(i, j) - back(i, j) + (i == j ? 0 : forth(j, i) - back(j, i))) / 4;
  }

 private:
  double forth(int i, int j) const { return g_.forth(q_, d_, i, j); }
  double back(int i, int j) const { return g_.back(q_, d_, i, j); }

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

ShiftExpansion::Sample::Sample(const Model& model, int sheets) {
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

ShiftExpansion::Sample::~Sample() = default;

ShiftExpansion::ShiftExpansion(const ShiftGradients& gradients)
    : vertices_(gradients.coordinates() / 2),
      diagonals_(gradients.diagonals()),
      groups_((diagonals_ + kDiagonals - 1) / kDiagonals),
      singles_(static_cast<std::size_t>(groups_ * vertices_) * kPlaces * kRow),
      products_(gradients.coordinates()) {
  products_.entries.resize(bytes(vertices_, diagonals_));
  products_.totals.resize(static_cast<std::size_t>(groups_) * kRow);
  for (const ShiftedQuantity quantity : {ShiftedQuantity::elongation, ShiftedQuantity::slope}) {
    Kind& kind = kinds_[static_cast<int>(quantity)];
    kind.unit.assign(static_cast<std::size_t>(groups_ * kDiagonals), 0);
    kind.share = kind.second_unit = kind.unit;
    kind.least.assign(static_cast<std::size_t>(groups_), 0);
    for (int d = 0; d < diagonals_; ++d) {
      const Polynomial polynomial(gradients, quantity, d);
      const int group = d / kDiagonals;
      const int column = static_cast<int>(quantity) * kDiagonals + d % kDiagonals;
      kind.unit[static_cast<std::size_t>(d)] = fill_singles(group, column, polynomial);
      kind.second_unit[static_cast<std::size_t>(d)] = fill_products(group, column, polynomial);
    }
  }
}

ShiftExpansion::~ShiftExpansion() = default;

std::size_t ShiftExpansion::bytes(int vertices, int diagonals) {
  const std::size_t groups = static_cast<std::size_t>((diagonals + kDiagonals - 1) / kDiagonals);
  const std::size_t quads = static_cast<std::size_t>(ProductTable(2 * vertices).all_quads());
  return groups * quads * ProductTable::kQuad * kRow;
}

float ShiftExpansion::fill_singles(int group, int column, const Polynomial& polynomial) {
  std::vector<double> linear;
  double bound = 0;
  for (int j = 0; j < products_.coordinates; ++j) {
    linear.push_back(polynomial.linear(j));
    bound += std::abs(linear.back());
  }
  const double unit = bound / kLargestSum;
  for (int vertex = 0; vertex < vertices_; ++vertex) {
    const double* const weights = linear.data() + 2 * vertex;
    for (const int x : {-1, 0, 1}) {
      for (const int y : {-1, 0, 1}) {
        singles_[at_single(group, vertex, place_of(x, y)) + static_cast<std::size_t>(column)] =
            static_cast<Short>(std::lround((x * weights[0] + y * weights[1]) / unit));
      }
    }
  }
  return static_cast<float>(unit);
}

float ShiftExpansion::fill_products(int group, int column, const Polynomial& polynomial) {
  const int coordinates = products_.coordinates;
  double largest = 0, bound = 0;
  for (int i = 0; i < coordinates; ++i) {
    for (int j = i; j < coordinates; ++j) {
      const double size = std::abs(polynomial.product(i, j));
      largest = std::max(largest, size);
      bound += size;
    }
  }
  const double unit = std::max(largest / kLargestByte, bound / kLargestSum);
  std::int32_t& total = products_.totals[static_cast<std::size_t>(group * kRow + column)];
  ProductTable::Byte* quad = products_.entries.data() +
                             ProductTable::kQuad * (products_.all_quads() * group * kRow + column);
  for (int i = 0; i < coordinates; ++i) {
    for (int j = i; j < coordinates; ++j) {
      ProductTable::Byte& entry = quad[(j - i) / ProductTable::kQuad * ProductTable::kQuad * kRow +
                                       (j - i) % ProductTable::kQuad];
      entry = static_cast<ProductTable::Byte>(std::lround(polynomial.product(i, j) / unit));
      total += entry;
    }
    quad += products_.quads_from(i) * ProductTable::kQuad * kRow;
  }
  return static_cast<float>(unit);
}

void ShiftExpansion::calibrate(int group, const std::vector<Short>& sums, const Sample& sample) {
  const std::size_t sheets = sample.is_known.size();
  assert(sums.size() >= sheets * kSums);
  assert(sample.slopes.size() == sheets * static_cast<std::size_t>(diagonals_));
  for (const ShiftedQuantity quantity : {ShiftedQuantity::elongation, ShiftedQuantity::slope}) {
    const int which = static_cast<int>(quantity);
    const std::vector<double>& truth = which == 0 ? sample.elongations : sample.slopes;
    Kind& kind = kinds_[which];
    std::vector<float> orders(sheets);
    for (std::size_t s = 0; s < sheets; ++s) {
      orders[s] = second_order(which, group, sums.data() + s * kSums);
    }
    std::vector<float> sorted = orders;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sheets / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const float least = kind.least[static_cast<std::size_t>(group)] = kLeastOrder * *middle;
    float* const share = kind.share.data() + group * kDiagonals;
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
