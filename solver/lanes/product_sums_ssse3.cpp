// This file is compiled with -mssse3.
#include <immintrin.h>

#include "solver/lanes/product_kernel.hpp"

namespace misalign::solver {
namespace {

struct Four : TwoSums {
  using Register = __m128i;
  static constexpr std::size_t kSheets = 2;
  static void add(int four, const __m128i* entries, __m128i* sums) {
    const __m128i products = _mm_set1_epi32(four);
    for (int k = 0; k < 4; ++k) {
      sums[k] = _mm_add_epi16(sums[k], _mm_maddubs_epi16(products, entries[k]));
    }
  }
};

}  // namespace

void add_products_ssse3(const ProductTable& table, int group, const signed char* signs,
                        const int* sheets, std::size_t count, std::int32_t* rows,
                        std::int16_t* sums, std::size_t stride) {
  add_products<Four>(table, group, signs, sheets, count, rows, sums, stride);
}

}  // namespace misalign::solver
