// This file is compiled with -mavx2.
#include <immintrin.h>

#include "solver/lanes/product_kernel.hpp"

namespace misalign::solver {
namespace {

struct Four : TwoSums {
  using Register = __m256i;
  static constexpr std::size_t kSheets = 4;
  static void add(int four, const __m256i* entries, __m256i* sums) {
    const __m256i products = _mm256_set1_epi32(four);
    for (int k = 0; k < 2; ++k) {
      sums[k] = _mm256_add_epi16(sums[k], _mm256_maddubs_epi16(products, entries[k]));
    }
  }
};

}  // namespace

void add_products_avx2(const ProductTable& table, int group, const signed char* signs,
                       const int* sheets, std::size_t count, std::int32_t* rows, std::int16_t* sums,
                       std::size_t stride) {
  add_products<Four>(table, group, signs, sheets, count, rows, sums, stride);
}

}  // namespace misalign::solver
