// Makes random words by counter: the k-th word of a draw is a pure function of seed, draw and k.
#pragma once

#include <array>
#include <cstdint>

namespace misalign::search {

/// Philox4x32-10 (Random123), key = (low, high half of the seed), counter = (low, high half of the
/// draw, block, stream). Stream 0 is draws; 1 is miscut copies and 2 loose joints, with the trial
/// in the draw's place; 3 is splitting, see StepWords; 4 is what a descent to a shape
/// varies by draw; the rest is reserved.
inline constexpr std::uint32_t kDrawStream = 0, kToleranceStream = 1, kBacklashStream = 2,
                               kSplittingStream = 3, kShapeStream = 4;
std::array<std::uint32_t, 4> philox_block(std::uint64_t seed, std::uint64_t draw,
                                          std::uint32_t block, std::uint32_t stream);

/// Computes the blocks of kDrawsAtOnce consecutive draws; `words` has each word of all draws.
inline constexpr int kDrawsAtOnce = 16;
using WordsOfDraws = std::array<std::array<std::uint32_t, kDrawsAtOnce>, 4>;
void philox_blocks(std::uint64_t seed, std::uint64_t first_draw, std::uint32_t block,
                   std::uint32_t stream, WordsOfDraws& words);
/// Computes the same with AVX2, which the machine must have.
void philox_avx2(std::uint64_t seed, std::uint64_t first_draw, std::uint32_t block,
                 std::uint32_t stream, WordsOfDraws& words);

/// Returns floor(3 w / 2^32) - 1.
int ternary_level(std::uint32_t word);
/// Returns (w + 0.5) / 2^31 - 1, on (-1, 1).
double uniform_share(std::uint32_t word);

/// Returns whether the generator gives the published known answers (Random123's, and seed 1 draw
/// 0).
bool random_numbers_as_published();

}  // namespace misalign::search
