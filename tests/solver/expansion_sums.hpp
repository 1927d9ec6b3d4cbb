// The sums of a ShiftExpansion's tables, without registers.
#pragma once

#include "solver/model/shift_expansion.hpp"

namespace misalign::solver {

// The sums of one sheet and group: vertex by vertex and product by product.
inline std::vector<ShiftExpansion::Short> sums_of(const ShiftExpansion& tables, int group,
                                                  const double* shifts) {
  using Short = ShiftExpansion::Short;
  constexpr int kRow = ShiftExpansion::kRow;
  std::vector<Short> sums(ShiftExpansion::kSums);
  const auto sign = [&](int i) { return shifts[i] > 0 ? 1 : shifts[i] < 0 ? -1 : 0; };
  const auto place = [&](int v) { return ShiftExpansion::place_of(sign(2 * v), sign(2 * v + 1)); };
  const auto add = [](Short& to, int term) { to = static_cast<Short>(to + term); };
  for (int g = 0; g < tables.vertices(); ++g) {
    for (int k = 0; k < kRow; ++k) add(sums[k], tables.single(group, g, place(g))[k]);
  }
  const ProductTable& products = tables.products();
  const ProductTable::Byte* quad =
      products.entries.data() + group * products.all_quads() * ProductTable::kQuad * kRow;
  for (int i = 0; i < products.coordinates; ++i) {
    for (int j = i; j < products.coordinates; ++j) {
      const ProductTable::Byte* const entries = quad + (j - i) / 4 * 4 * kRow + (j - i) % 4;
      for (int k = 0; k < kRow; ++k) add(sums[kRow + k], sign(i) * sign(j) * entries[4 * k]);
    }
    quad += products.quads_from(i) * ProductTable::kQuad * kRow;
  }
  return sums;
}

}  // namespace misalign::solver
