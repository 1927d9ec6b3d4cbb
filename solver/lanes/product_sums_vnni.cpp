// Compiled with -mavx512f -mavx512bw -mavx512vnni.
#include <immintrin.h>

#include <cassert>

#include "solver/lanes/product_sums.hpp"

namespace misalign::solver {
namespace {

constexpr int kBytes = 64;  // of a register
// Whose entries, and products of those sheets, stay in the nearest cache.
constexpr int kMostQuads = 192;

// Products of the coordinate `i` with itself and those after it, plus 1: the multiplication wants
// one factor without a sign.
void multiply(const signed char* signs, int i, int count, unsigned char* products) {
  const __m512i by = _mm512_set1_epi8(signs[i]), one = _mm512_set1_epi8(1);
  const __mmask64 is_not_zero = _mm512_test_epi8_mask(by, by);
  const __mmask64 is_negative = _mm512_movepi8_mask(by);
  for (int j = 0; j < count; j += kBytes) {
    const __m512i others = _mm512_maskz_loadu_epi8(is_not_zero, signs + i + j);
    const __m512i sum = _mm512_add_epi8(others, one);
    _mm512_storeu_si512(products + j, _mm512_mask_sub_epi8(sum, is_negative, one, others));
  }
}

// Written out: GCC 12 copies sums to and fro about its own _mm512_dpbusd_epi32.
inline void add_four(const __m512i& products, const __m512i& entries, __m512i& sum) {
  asm("vpdpbusd %2, %1, %0" : "+v"(sum) : "v"(products), "v"(entries));
}

// Adds products of sheets, `stride` bytes from sheet to sheet, times their entries to the sheets'
// rows. A call: inlined, it leaves sums in memory.
[[gnu::noinline]] void add_block(const unsigned char* products, std::size_t stride,
                                 const __m512i* entries, int quads, std::int32_t* rows) {
  __m512i sums[kProductSheets];
#pragma GCC unroll 16
  for (std::size_t s = 0; s < kProductSheets; ++s) {
    sums[s] = _mm512_loadu_si512(rows + ShiftExpansion::kRow * s);
  }
  for (int quad = 0; quad < quads; ++quad, products += ProductTable::kQuad) {
    const __m512i here = *entries++;
#pragma GCC unroll 16
    for (std::size_t s = 0; s < kProductSheets; ++s) {
      int four;
      __builtin_memcpy(&four, products + stride * s, sizeof four);
      add_four(_mm512_set1_epi32(four), here, sums[s]);
    }
  }
#pragma GCC unroll 16
  for (std::size_t s = 0; s < kProductSheets; ++s) {
    _mm512_storeu_si512(rows + ShiftExpansion::kRow * s, sums[s]);
  }
}

// The first coordinate that does not belong to the block from `first` on.
int end_of_block(const ProductTable& table, int first) {
  int end = first, quads = 0;
  while (end < table.coordinates && (end == first || quads + table.quads(end) <= kMostQuads)) {
    quads += table.quads(end++);
  }
  return end;
}

}  // namespace

void add_products_vnni(const ProductTable& table, int group, const signed char* signs,
                       const int* sheets, std::size_t count, std::int32_t* rows, std::int16_t* sums,
                       std::size_t stride) {
  constexpr std::size_t kRow = ShiftExpansion::kRow;
  static_assert(kRow * sizeof(std::int32_t) == kBytes);
  assert(table.quads(0) <= kMostQuads);
  const std::size_t signs_stride =
      static_cast<std::size_t>(table.coordinates + ProductSums::kPadding);
  const __m512i less = _mm512_sub_epi32(
      _mm512_setzero_si512(),
      _mm512_loadu_si512(table.totals.data() + kRow * static_cast<std::size_t>(group)));
  const std::size_t batches = (count + kProductSheets - 1) / kProductSheets;
  for (std::size_t k = 0; k < batches * kProductSheets; ++k) {
    _mm512_storeu_si512(rows + k * kRow, less);
  }
  const __m512i* entries =
      reinterpret_cast<const __m512i*>(table.entries.data()) + table.all_quads() * group;
  alignas(
      kBytes) unsigned char products[kProductSheets][kMostQuads * ProductTable::kQuad + 2 * kBytes];
  for (int first = 0; first < table.coordinates;) {
    const int end = end_of_block(table, first);
    int quads = 0;
    for (std::size_t batch = 0; batch < count; batch += kProductSheets) {
      for (std::size_t s = 0; s < kProductSheets && batch + s < count; ++s) {
        const signed char* const of_sheet =
            signs + signs_stride * static_cast<std::size_t>(sheets[batch + s]);
        quads = 0;
        for (int i = first; i < end; ++i) {
          multiply(of_sheet, i, table.coordinates - i, products[s] + ProductTable::kQuad * quads);
          quads += table.quads(i);
        }
      }
      add_block(products[0], sizeof products[0], entries, quads, rows + batch * kRow);
    }
    entries += quads;
    first = end;
  }
  for (std::size_t k = 0; k < count; ++k, sums += stride) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(sums),
                        _mm512_cvtepi32_epi16(_mm512_loadu_si512(rows + k * kRow)));
  }
}

}  // namespace misalign::solver
