// Sums of products by each kind of register, against one product after another.
#include "solver/lanes/product_sums.hpp"

#include <gtest/gtest.h>

#include <random>

namespace misalign::solver {
namespace {

constexpr int kGroups = 2, kSheets = 37, kRow = ProductTable::kRow;

// No entry is below zero: with products that are one too large sums leave the shorts' range on the
// way, and come back.
struct DrawnForms {
  explicit DrawnForms(int coordinates)
      : table(coordinates), stride(static_cast<std::size_t>(coordinates + ProductTable::kPadding)) {
    for (int group = 0; group < kGroups; ++group) {
      for (int i = 0; i < coordinates; ++i) {
        for (int quad = 0; quad < table.quads_from(i); ++quad) add_quad(i, quad);
      }
    }
    table.totals.assign(static_cast<std::size_t>(kGroups * kRow), 0);
    for (std::size_t k = 0; k < table.entries.size(); ++k) {
      const std::size_t group = k * kGroups / table.entries.size();
      const std::size_t form = k / ProductTable::kQuad % kRow;
      table.totals[group * kRow + form] += table.entries[k];
    }
    signs.assign(kSheets * stride, 0);
    for (int sheet = 0; sheet < kSheets; ++sheet) {
      for (int i = 0; i < coordinates; ++i) {
        signs[static_cast<std::size_t>(sheet) * stride + static_cast<std::size_t>(i)] =
            static_cast<signed char>(static_cast<int>(words() % 3) - 1);
      }
    }
  }
  void add_quad(int coordinate, int quad) {
    for (int form = 0; form < kRow; ++form) {
      for (int k = 0; k < ProductTable::kQuad; ++k) {
        const bool is_there = coordinate + quad * ProductTable::kQuad + k < table.coordinates;
        const auto entry = words() % 500 == 0 ? 127 : words() % 20;
        table.entries.push_back(static_cast<ProductTable::Byte>(is_there ? entry : 0));
      }
    }
  }
  int sum(int group, int form, int sheet) const {
    const signed char* const of = signs.data() + static_cast<std::size_t>(sheet) * stride;
    const ProductTable::Byte* entry =
        table.entries.data() + table.entries.size() / kGroups * group + form * ProductTable::kQuad;
    int sum = 0;
    for (int i = 0; i < table.coordinates; ++i) {
      for (int j = i; j < table.coordinates; ++j) {
        sum += of[i] * of[j] *
               entry[(j - i) / ProductTable::kQuad * ProductTable::kQuad * kRow +
                     (j - i) % ProductTable::kQuad];
      }
      entry += table.quads_from(i) * ProductTable::kQuad * kRow;
    }
    return sum;
  }

  std::mt19937 words;
  ProductTable table;
  const std::size_t stride;
  std::vector<signed char> signs;
};

class ProductSumsBy : public testing::TestWithParam<int> {};

TEST_P(ProductSumsBy, AreThoseOfOneProductAfterAnother) {
  constexpr std::int16_t kUntouched = 12345;
  constexpr std::size_t kStride = kRow + 3;
  for (const int coordinates : {2, 50, 162}) {  // 162: in several blocks
    SCOPED_TRACE(coordinates);
    const DrawnForms forms(coordinates);
    ProductSums by_registers(static_cast<std::size_t>(GetParam()));
    for (int group = 0; group < kGroups; ++group) {
      const std::vector<int> asked = {36, 0, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 30, 31, 1};
      std::vector<std::int16_t> sums(asked.size() * kStride, kUntouched);
      by_registers.find(forms.table, group, forms.signs.data(), asked, sums.data(), kStride);
      for (std::size_t k = 0; k < asked.size(); ++k) {
        for (int form = 0; form < kRow; ++form) {
          ASSERT_EQ(sums[k * kStride + static_cast<std::size_t>(form)],
                    forms.sum(group, form, asked[k]))
              << "group " << group << ", form " << form << ", sheet " << asked[k];
        }
        EXPECT_EQ(sums[k * kStride + kRow], kUntouched);
      }
    }
  }
}

// 0: what every machine has.
INSTANTIATE_TEST_SUITE_P(Bytes, ProductSumsBy, testing::Values(0, 16, 32, 64));

}  // namespace
}  // namespace misalign::solver
