// Evaluates the quadratic forms of a ProductTable for many sheets.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/lanes/product_kernel.hpp"

namespace misalign::solver {

class ProductSums {
 public:
  /// Uses this machine's registers of at most this size (bytes).
  explicit ProductSums(std::size_t most_bytes);
  ~ProductSums();

  /// Finds the forms of a group for these sheets: kRow shorts each, `stride` shorts from one to the
  /// next. `signs` are -1, 0 or 1: each sheet, by its number, has one per coordinate and kPadding
  /// zeros.
  void find(const ProductTable& table, int group, const signed char* signs,
            const std::vector<int>& sheets, std::int16_t* sums, std::size_t stride);

 private:
  AddProducts* add_;
  std::vector<std::int32_t, xsimd::aligned_allocator<std::int32_t, 64>> rows_;
};

}  // namespace misalign::solver
