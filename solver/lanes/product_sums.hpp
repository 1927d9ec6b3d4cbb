// The quadratic forms of a ProductTable for many sheets.
#pragma once

#include <cstdint>

#include "solver/model/shift_expansion.hpp"

namespace misalign::solver {

class ProductSums {
 public:
  /// With registers of no more bytes than that, as this machine has them.
  explicit ProductSums(std::size_t most_bytes);
  ~ProductSums();

  /// The forms of a group, for these sheets: kRow shorts each, `stride` shorts from one to the
  /// next. `signs` are -1, 0 or 1: of each sheet, by its number, one per coordinate and kPadding
  /// zeros.
  void find(const ProductTable& table, int group, const signed char* signs,
            const std::vector<int>& sheets, std::int16_t* sums, std::size_t stride);

  /// So many rows more than there are sheets are written to.
  static constexpr std::size_t kMoreRows = 16;
  using Function = void(const ProductTable& table, int group, const signed char* signs,
                        const int* sheets, std::size_t count, std::int32_t* rows,
                        std::int16_t* sums, std::size_t stride);

 private:
  Function* add_;
  std::vector<std::int32_t, xsimd::aligned_allocator<std::int32_t, 64>> rows_;
};

#ifdef MISALIGN_X86
/// Each in a file with flags of its own, which allocates nothing.
ProductSums::Function add_products_ssse3, add_products_avx2, add_products_vnni;
#endif

}  // namespace misalign::solver
