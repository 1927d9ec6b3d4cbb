// Compiled with -mavx2.
#include <immintrin.h>

#include "search/draws/philox_lanes.hpp"

namespace misalign::search {

void philox_avx2(std::uint64_t seed, std::uint64_t first_draw, std::uint32_t block,
                 std::uint32_t stream, WordsOfDraws& words) {
  using Lanes [[gnu::vector_size(32)]] = std::uint64_t;
  philox_in_lanes<Lanes>(seed, first_draw, block, stream, words,
                         [](const Lanes& a, const Lanes& b) {
                           return Lanes(_mm256_mul_epu32(__m256i(a), __m256i(b)));
                         });
}

}  // namespace misalign::search
