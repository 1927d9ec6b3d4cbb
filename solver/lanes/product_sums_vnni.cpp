// This file is compiled with -mavx512f -mavx512bw -mavx512vnni.
#include <immintrin.h>

#include "solver/lanes/product_kernel.hpp"

namespace misalign::solver {
namespace {

struct Four {
  using Register = __m512i;
  static constexpr std::size_t kSheets = 16;
  // The instruction is written out: GCC 12 copies sums to and fro about its own
  // _mm512_dpbusd_epi32.
  static void add(int four, const __m512i* entries, __m512i* sum) {
    asm("vpdpbusd %2, %1, %0" : "+v"(*sum) : "v"(_mm512_set1_epi32(four)), "v"(*entries));
  }
  static std::int16_t sum(std::int32_t all) { return static_cast<std::int16_t>(all); }
};

}  // namespace

void add_products_vnni(const ProductTable& table, int group, const signed char* signs,
                       const int* sheets, std::size_t count, std::int32_t* rows, std::int16_t* sums,
                       std::size_t stride) {
  add_products<Four>(table, group, signs, sheets, count, rows, sums, stride);
}

}  // namespace misalign::solver
