// Compiled with -mavx512f.
#include <immintrin.h>

#include "search/draws/philox_lanes.hpp"

namespace misalign::search {

void philox_avx512(std::uint64_t seed, std::uint64_t first_draw, std::uint32_t block,
                   std::uint32_t stream, WordsOfDraws& words) {
  using Lanes [[gnu::vector_size(64)]] = std::uint64_t;
  philox_in_lanes<Lanes>(seed, first_draw, block, stream, words,
                         [](const Lanes& a, const Lanes& b) {
                           return Lanes(_mm512_mul_epu32(__m512i(a), __m512i(b)));
                         });
}

}  // namespace misalign::search
