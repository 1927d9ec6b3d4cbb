#include "solver/lanes/product_sums.hpp"

namespace misalign::solver {

ProductSums::ProductSums() = default;

ProductSums::~ProductSums() = default;

bool ProductSums::are_fast() {
#ifdef MISALIGN_X86
  return __builtin_cpu_supports("avx512vnni") && __builtin_cpu_supports("avx512bw");
#else
  return false;
#endif
}

void ProductSums::find([[maybe_unused]] const ProductTable& table, [[maybe_unused]] int group,
                       [[maybe_unused]] const signed char* signs,
                       [[maybe_unused]] const std::vector<int>& sheets,
                       [[maybe_unused]] std::int16_t* sums, [[maybe_unused]] std::size_t stride) {
#ifdef MISALIGN_X86
  rows_.resize((sheets.size() + kProductSheets) * ShiftExpansion::kRow);
  add_products_vnni(table, group, signs, sheets.data(), sheets.size(), rows_.data(), sums, stride);
#endif
}

}  // namespace misalign::solver
