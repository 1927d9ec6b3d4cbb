// Computes Philox4x32-10 for four draws in a register, compiled with -mavx2. The words are
// Random123's: Salmon, Moraes, Dror & Shaw, Parallel random numbers: as easy as 1, 2, 3 (2011).
#include <immintrin.h>

#include <cstring>

#include "search/draws/random_words.hpp"

namespace misalign::search {
namespace {

constexpr int kLanes = 4;
using Lanes [[gnu::vector_size(kLanes * sizeof(std::uint64_t))]] = std::uint64_t;
using Words [[gnu::vector_size(kLanes * sizeof(std::uint32_t))]] = std::uint32_t;

// Returns the products of the low halves.
Lanes product(const Lanes& a, std::uint32_t b) {
  return Lanes(_mm256_mul_epu32(__m256i(a), _mm256_set1_epi64x(b)));
}

}  // namespace

void philox_avx2(std::uint64_t seed, std::uint64_t first_draw, std::uint32_t block,
                 std::uint32_t stream, WordsOfDraws& words) {
  const Lanes none = {};
  for (int first = 0; first < kDrawsAtOnce; first += kLanes) {
    // Bits above a lane's 32 stay as they are: multiplications ignore them.
    Lanes counter[4] = {none, none, none + block, none + stream};
    for (int i = 0; i < kLanes; ++i) {
      counter[0][i] = first_draw + static_cast<std::uint64_t>(first + i);
      counter[1][i] = counter[0][i] >> 32;
    }
    std::uint64_t key[2] = {seed & 0xffffffff, seed >> 32};
    for (int round = 0; round < 10; ++round) {
      const Lanes a = product(counter[0], 0xD2511F53u), b = product(counter[2], 0xCD9E8D57u);
      counter[0] = (b >> 32) ^ counter[1] ^ key[0];
      counter[1] = b;
      counter[2] = (a >> 32) ^ counter[3] ^ key[1];
      counter[3] = a;
      key[0] = (key[0] + 0x9E3779B9u) & 0xffffffff;
      key[1] = (key[1] + 0xBB67AE85u) & 0xffffffff;
    }
    for (int i = 0; i < 4; ++i) {
      const Words narrow = __builtin_convertvector(counter[i], Words);
      std::memcpy(words[static_cast<std::size_t>(i)].data() + first, &narrow, sizeof narrow);
    }
  }
}

}  // namespace misalign::search
