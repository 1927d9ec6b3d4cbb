// Evaluates the quadratic forms of a ProductTable for many sheets, with any instruction that
// multiplies bytes: a file with flags of its own defines `Four` and calls add_products<Four>.
// `Four` is in an unnamed namespace, which keeps all that is compiled with these flags in that
// file.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>

#include "solver/model/product_table.hpp"

namespace misalign::solver {

/// Rows that are written to beyond those of the sheets.
inline constexpr std::size_t kMoreRows = 16;

// Four products of each form lie side by side, and where bytes are added up two at a time so do
// their two sums. Shorts may overflow on the way: what they come to in the end fits.
struct TwoSums {
  static std::int16_t sum(std::int32_t both) {
    const std::uint32_t bits = static_cast<std::uint32_t>(both);
    return static_cast<std::int16_t>(bits + (bits >> 16));
  }
};

/// Four::Register; kSheets, whose sums stay in registers; add(four, entries, sums): to the sums of
/// one sheet four products, without a sign, times their entries; sum(what lies there of a form).
template <class Four>
class ProductKernel {
 public:
  using Register = typename Four::Register;
  static constexpr int kRow = ProductTable::kRow, kQuad = ProductTable::kQuad;
  static constexpr int kBytes = sizeof(Register), kRegisters = kRow * kQuad / kBytes;
  static constexpr std::size_t kSheets = Four::kSheets;
  static_assert(kSheets <= kMoreRows);
  // Entries of this size, and the products of kSheets sheets, stay in the nearest cache.
  static constexpr int kMostQuads = ProductTable::kMostCoordinates / kQuad;

  ProductKernel(const ProductTable& table, const signed char* signs, const int* sheets,
                std::size_t count)
      : table_(table), signs_(signs), sheets_(sheets), count_(count) {
    assert(table.coordinates <= ProductTable::kMostCoordinates);
  }

  void find(int group, std::int32_t* rows, std::int16_t* sums, std::size_t stride) {
    const std::int32_t* const totals = table_.totals.data() + kRow * group;
    for (std::size_t k = 0; k < count_ + kSheets; ++k) {
      for (int form = 0; form < kRow; ++form) {
        rows[kRow * k + form] = static_cast<std::uint16_t>(-totals[form]);
      }
    }
    const auto* entries = reinterpret_cast<const Register*>(table_.entries.data()) +
                          table_.all_quads() * group * kRegisters;
    for (int first = 0; first < table_.coordinates;) {
      int end = first, quads = 0;
      while (end < table_.coordinates && quads + table_.quads_from(end) <= kMostQuads) {
        quads += table_.quads_from(end++);
      }
      for (std::size_t batch = 0; batch < count_; batch += kSheets) {
        for (std::size_t s = 0; s < kSheets && batch + s < count_; ++s) {
          multiply(sheets_[batch + s], first, end, products_[s]);
        }
        add_block(entries, quads, rows + kRow * batch);
      }
      entries += quads * kRegisters;
      first = end;
    }
    for (std::size_t k = 0; k < count_; ++k, sums += stride) {
      for (int form = 0; form < kRow; ++form) sums[form] = Four::sum(rows[kRow * k + form]);
    }
  }

 private:
  using Bytes [[gnu::vector_size(kBytes), gnu::aligned(1), gnu::may_alias]] = signed char;

  // Products of these coordinates with themselves and those after them, plus 1: the multiplication
  // wants one factor without a sign. Nothing is read from the table on the way, which stores of
  // bytes might change.
  void multiply(int sheet, int first, int end, signed char* products) const {
    const int coordinates = table_.coordinates;
    const signed char* signs =
        signs_ + static_cast<std::ptrdiff_t>(sheet) * (coordinates + ProductTable::kPadding) +
        first;
    for (int count = coordinates - first; count > coordinates - end; --count, ++signs) {
      const Bytes sign = Bytes{} + *signs, flip = sign < 0, keep = sign != 0;
      for (int j = 0; j < count; j += kBytes) {
        const Bytes others = *reinterpret_cast<const Bytes*>(signs + j);
        *reinterpret_cast<Bytes*>(products + j) = (((others ^ flip) - flip) & keep) + 1;
      }
      products += kQuad * ProductTable::quads(count);
    }
  }

  // Adds products times their entries to the rows of kSheets sheets. Never inlined: that would
  // leave sums in memory.
  [[gnu::noinline]] void add_block(const Register* entries, int quads, std::int32_t* rows) const {
    Register sums[kSheets * kRegisters];
    auto* const all = reinterpret_cast<Register*>(rows);
#pragma GCC unroll 16
    for (std::size_t k = 0; k < kSheets * kRegisters; ++k) sums[k] = all[k];
    const signed char* products = products_[0];
    for (int quad = 0; quad < quads; ++quad, products += kQuad, entries += kRegisters) {
#pragma GCC unroll 16
      for (std::size_t s = 0; s < kSheets; ++s) {
        int four;
        __builtin_memcpy(&four, products + sizeof products_[0] * s, sizeof four);
        Four::add(four, entries, sums + kRegisters * s);
      }
    }
#pragma GCC unroll 16
    for (std::size_t k = 0; k < kSheets * kRegisters; ++k) all[k] = sums[k];
  }

  const ProductTable& table_;
  const signed char* const signs_;
  const int* const sheets_;
  const std::size_t count_;
  alignas(64) signed char products_[kSheets][kMostQuads * kQuad + 2 * ProductTable::kPadding];
};

/// Evaluates the forms of a group for these sheets: see ProductSums::find.
using AddProducts = void(const ProductTable& table, int group, const signed char* signs,
                         const int* sheets, std::size_t count, std::int32_t* rows,
                         std::int16_t* sums, std::size_t stride);
template <class Four>
void add_products(const ProductTable& table, int group, const signed char* signs, const int* sheets,
                  std::size_t count, std::int32_t* rows, std::int16_t* sums, std::size_t stride) {
  ProductKernel<Four>(table, signs, sheets, count).find(group, rows, sums, stride);
}

#ifdef MISALIGN_X86
/// Each is in a file with its own flags, which allocates nothing.
AddProducts add_products_ssse3, add_products_avx2, add_products_vnni;
#endif

}  // namespace misalign::solver
