#include "solver/lanes/product_sums.hpp"

namespace misalign::solver {
namespace {

// Does in several instructions what others do in one. Sums are unsigned: they may overflow.
struct Four : TwoSums {
  using Register [[gnu::vector_size(16), gnu::may_alias]] = unsigned short;
  static constexpr std::size_t kSheets = 2;
  static void add(int four, const Register* entries, Register* sums) {
    using Ints [[gnu::vector_size(16)]] = int;
    using Shorts [[gnu::vector_size(16)]] = short;
    const Register products = reinterpret_cast<Register>(Ints{} + four);
    for (int k = 0; k < 4; ++k) {
      const Register even =
          reinterpret_cast<Register>(reinterpret_cast<Shorts>(entries[k] << 8) >> 8);
      const Register odd = reinterpret_cast<Register>(reinterpret_cast<Shorts>(entries[k]) >> 8);
      sums[k] += (products & 255) * even + (products >> 8) * odd;
    }
  }
};

}  // namespace

ProductSums::ProductSums([[maybe_unused]] std::size_t most_bytes) : add_(add_products<Four>) {
#ifdef MISALIGN_X86
  if (most_bytes >= 64 && __builtin_cpu_supports("avx512vnni") &&
      __builtin_cpu_supports("avx512bw")) {
    add_ = add_products_vnni;
  } else if (most_bytes >= 32 && __builtin_cpu_supports("avx2")) {
    add_ = add_products_avx2;
  } else if (most_bytes >= 16 && __builtin_cpu_supports("ssse3")) {
    add_ = add_products_ssse3;
  }
#endif
}

ProductSums::~ProductSums() = default;

void ProductSums::find(const ProductTable& table, int group, const signed char* signs,
                       const std::vector<int>& sheets, std::int16_t* sums, std::size_t stride) {
  rows_.resize((sheets.size() + kMoreRows) * ProductTable::kRow);
  add_(table, group, signs, sheets.data(), sheets.size(), rows_.data(), sums, stride);
}

}  // namespace misalign::solver
