// The sums of a ShiftExpansion's tables, without registers.
#pragma once

#include "solver/model/shift_expansion.hpp"

namespace misalign::solver {

// The sums of one sheet, vertex by vertex and pair by pair.
inline std::vector<ShiftExpansion::Short> sums_of(const ShiftExpansion& tables,
                                                  const double* shifts) {
  constexpr int kRow = ShiftExpansion::kRow;
  std::vector<ShiftExpansion::Short> sums(tables.sums());
  const auto sign = [](double shift) { return shift > 0 ? 1 : shift < 0 ? -1 : 0; };
  const auto place = [&](int v) {
    return ShiftExpansion::place_of(sign(shifts[2 * v]), sign(shifts[2 * v + 1]));
  };
  for (int group = 0; group < tables.groups(); ++group) {
    ShiftExpansion::Short* const of_group = sums.data() + group * 2 * kRow;
    const auto add = [](ShiftExpansion::Short& to, int term) {
      to = static_cast<ShiftExpansion::Short>(to + term);
    };
    for (int g = 0; g < tables.vertices(); ++g) {
      for (int k = 0; k < 2 * kRow; ++k) add(of_group[k], tables.single(group, g, place(g))[k]);
      const ShiftExpansion::Short* row = tables.pair(group, g, place(g));
      for (int h = g + 1; h < tables.vertices(); ++h, row += ShiftExpansion::kPlaces * kRow) {
        for (int k = 0; k < kRow; ++k) add(of_group[kRow + k], row[place(h) * kRow + k]);
      }
    }
  }
  return sums;
}

}  // namespace misalign::solver
