// The quadratic forms of a ProductTable for many sheets, on machines that multiply bytes and add
// them up four at a time (AVX-512 VNNI): compiled with its own flags, like the lanes.
#pragma once

#include <cstdint>

#include "solver/model/shift_expansion.hpp"

namespace misalign::solver {

/// Of this build and this machine.
bool multiplies_bytes();

class ProductSums {
 public:
  /// Signs of a sheet are followed by this many zeros, so that they can be read a register at once.
  static constexpr int kPadding = 64;

  ProductSums();
  ~ProductSums();

  /// The forms of a group, for these sheets: kRow shorts each, `stride` shorts from one to the
  /// next. `signs` are -1, 0 or 1: of each sheet, by its number, one per coordinate and kPadding
  /// zeros.
  void find(const ProductTable& table, int group, const signed char* signs,
            const std::vector<int>& sheets, std::int16_t* sums, std::size_t stride);

 private:
  std::vector<std::int32_t> sums_;  // of all quads so far: of each sheet one row
};

}  // namespace misalign::solver
