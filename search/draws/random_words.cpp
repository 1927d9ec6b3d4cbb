#include "search/draws/random_words.hpp"

#include <Random123/philox.h>

namespace misalign::search {

std::array<std::uint32_t, 4> philox_block(std::uint64_t seed, std::uint64_t draw,
                                          std::uint32_t block, std::uint32_t stream) {
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  const r123::Philox4x32::ctr_type counter = {{low(draw), high(draw), block, stream}};
  const r123::Philox4x32::key_type key = {{low(seed), high(seed)}};
  const auto words = r123::Philox4x32{}(counter, key);
  return {words[0], words[1], words[2], words[3]};
}

void philox_blocks(std::uint64_t seed, std::uint64_t first_draw, std::uint32_t block,
                   std::uint32_t stream, WordsOfDraws& words) {
#ifdef MISALIGN_X86
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  if (has_avx2) return philox_avx2(seed, first_draw, block, stream, words);
#endif
  for (std::size_t draw = 0; draw < kDrawsAtOnce; ++draw) {
    const auto of_draw = philox_block(seed, first_draw + draw, block, stream);
    for (std::size_t i = 0; i < of_draw.size(); ++i) words[i][draw] = of_draw[i];
  }
}

int ternary_level(std::uint32_t word) {
  return static_cast<int>((3 * static_cast<std::uint64_t>(word)) >> 32) - 1;
}

double uniform_share(std::uint32_t word) { return (word + 0.5) / 2147483648.0 - 1.0; }

bool random_numbers_as_published() {
  using Block = std::array<std::uint32_t, 4>;
  return philox_block(0, 0, 0, 0) == Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8} &&
         philox_block(1, 0, 0, 0) == Block{0xe3e80670, 0xe50a0ebc, 0x95f222c0, 0xb615aa27};
}

}  // namespace misalign::search
