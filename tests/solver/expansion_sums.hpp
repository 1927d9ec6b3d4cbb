// The sums of a ShiftExpansion's tables, without registers.
#pragma once

#include "solver/model/shift_expansion.hpp"

namespace misalign::solver {

// The sums of one sheet and group: vertex by vertex, and pair by pair or product by product.
inline std::vector<ShiftExpansion::Short> sums_of(const ShiftExpansion& tables, int group,
                                                  const double* shifts) {
  using Short = ShiftExpansion::Short;
  constexpr int kRow = ShiftExpansion::kRow;
  std::vector<Short> sums(ShiftExpansion::kSums);
  const auto sign = [&](int i) { return shifts[i] > 0 ? 1 : shifts[i] < 0 ? -1 : 0; };
  const auto place = [&](int v) { return ShiftExpansion::place_of(sign(2 * v), sign(2 * v + 1)); };
  const auto add = [](Short& to, int term) { to = static_cast<Short>(to + term); };
  const bool by_pairs = tables.form() == SecondOrder::by_pairs;
  for (int g = 0; g < tables.vertices(); ++g) {
    for (int k = 0; k < 2 * kRow; ++k) add(sums[k], tables.single(group, g, place(g))[k]);
    if (!by_pairs) continue;
    const Short* row = tables.pair(group, g, place(g));
    for (int h = g + 1; h < tables.vertices(); ++h, row += ShiftExpansion::kPlaces * kRow) {
      for (int k = 0; k < kRow; ++k) add(sums[kRow + k], row[place(h) * kRow + k]);
    }
  }
  if (by_pairs) return sums;
  const ProductTable& products = tables.products();
  const ProductTable::Byte* quad =
      products.entries.data() + group * products.all_quads() * ProductTable::kQuad * kRow;
  for (int i = 0; i < products.coordinates; ++i) {
    for (int j = i; j < products.coordinates; ++j) {
      const ProductTable::Byte* const entries = quad + (j - i) / 4 * 4 * kRow + (j - i) % 4;
      for (int k = 0; k < kRow; ++k) add(sums[kRow + k], sign(i) * sign(j) * entries[4 * k]);
    }
    quad += products.quads(i) * ProductTable::kQuad * kRow;
  }
  return sums;
}

}  // namespace misalign::solver
