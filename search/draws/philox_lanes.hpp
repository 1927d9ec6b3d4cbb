// Philox4x32-10 for as many draws as a register has 64-bit lanes, word by word as Random123 has it:
// Salmon, Moraes, Dror & Shaw, Parallel random numbers: as easy as 1, 2, 3 (2011).
#pragma once

#include <cstdint>
#include <cstring>

#include "search/draws/random_words.hpp"

namespace misalign::search {

/// V is a vector of 64-bit numbers; `multiply` the products of the low halves of two of them. As
/// philox_blocks() says.
template <class V, class Multiply>
void philox_in_lanes(std::uint64_t seed, std::uint64_t first_draw, std::uint32_t block,
                     std::uint32_t stream, WordsOfDraws& words, const Multiply& multiply) {
  constexpr int kLanes = sizeof(V) / sizeof(std::uint64_t);
  using Words [[gnu::vector_size(kLanes * sizeof(std::uint32_t))]] = std::uint32_t;
  const V none = {};
  for (int first = 0; first < kDrawsAtOnce; first += kLanes) {
    // What a lane has above its 32 bits is left alone: multiplications do not see it.
    V counter[4] = {none, none, none + block, none + stream};
    for (int i = 0; i < kLanes; ++i) {
      counter[0][i] = first_draw + static_cast<std::uint64_t>(first + i);
      counter[1][i] = counter[0][i] >> 32;
    }
    std::uint64_t key[2] = {seed & 0xffffffff, seed >> 32};
    for (int round = 0; round < 10; ++round) {
      const V a = multiply(counter[0], none + 0xD2511F53u);
      const V b = multiply(counter[2], none + 0xCD9E8D57u);
      counter[0] = (b >> 32) ^ counter[1] ^ key[0];
      counter[1] = b;
      counter[2] = (a >> 32) ^ counter[3] ^ key[1];
      counter[3] = a;
      key[0] = (key[0] + 0x9E3779B9u) & 0xffffffff;
      key[1] = (key[1] + 0xBB67AE85u) & 0xffffffff;
    }
    for (int i = 0; i < 4; ++i) {
      const Words narrow = __builtin_convertvector(counter[i], Words);
      std::memcpy(&words[static_cast<std::size_t>(i)][static_cast<std::size_t>(first)], &narrow,
                  sizeof narrow);
    }
  }
}

#ifdef MISALIGN_X86
/// Each in a file with flags of its own.
void philox_avx2(std::uint64_t seed, std::uint64_t first_draw, std::uint32_t block,
                 std::uint32_t stream, WordsOfDraws& words);
void philox_avx512(std::uint64_t seed, std::uint64_t first_draw, std::uint32_t block,
                   std::uint32_t stream, WordsOfDraws& words);
#endif

}  // namespace misalign::search
