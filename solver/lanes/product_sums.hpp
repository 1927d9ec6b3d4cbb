// The quadratic forms of a ProductTable for many sheets, on machines that multiply bytes and add
// them up four at a time (AVX-512 VNNI).
#pragma once

#include <cstdint>

#include "solver/model/shift_expansion.hpp"

namespace misalign::solver {

/// So many sheets are looked at side by side.
inline constexpr std::size_t kProductSheets = 16;

class ProductSums {
 public:
  /// Signs of a sheet are followed by this many zeros, so that they can be read a register at once.
  static constexpr int kPadding = 64;

  ProductSums();
  ~ProductSums();

  /// Whether this build and this machine can.
  static bool are_fast();

  /// The forms of a group, for these sheets: kRow shorts each, `stride` shorts from one to the
  /// next. `signs` are -1, 0 or 1: of each sheet, by its number, one per coordinate and kPadding
  /// zeros. Only where they are fast.
  void find(const ProductTable& table, int group, const signed char* signs,
            const std::vector<int>& sheets, std::int16_t* sums, std::size_t stride);

 private:
  std::vector<std::int32_t> rows_;
};

/// The same in a file with flags of its own, which allocates nothing: `rows` has room for one more
/// kProductSheets of kRow than there are sheets.
void add_products_vnni(const ProductTable& table, int group, const signed char* signs,
                       const int* sheets, std::size_t count, std::int32_t* rows, std::int16_t* sums,
                       std::size_t stride);

}  // namespace misalign::solver
