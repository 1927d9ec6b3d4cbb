// Random words by counter: the k-th word of a draw is a pure function of seed, draw and k.
#pragma once

#include <array>
#include <cstdint>

namespace misalign::search {

/// Philox4x32-10 (Random123), key = (low, high half of the seed), counter = (low, high half of the
/// draw, block, stream). Stream 0 is draws; 1 is miscut copies and 2 loose joints, with the trial
/// in the draw's place; 3 is splitting, see StepWords; the rest is reserved.
inline constexpr std::uint32_t kDrawStream = 0, kToleranceStream = 1, kBacklashStream = 2,
                               kSplittingStream = 3;
std::array<std::uint32_t, 4> philox_block(std::uint64_t seed, std::uint64_t draw,
                                          std::uint32_t block, std::uint32_t stream);

/// The same of so many draws, one after the other: each of its words of all of them.
inline constexpr int kDrawsAtOnce = 16;
using WordsOfDraws = std::array<std::array<std::uint32_t, kDrawsAtOnce>, 4>;
void philox_blocks(std::uint64_t seed, std::uint64_t first_draw, std::uint32_t block,
                   std::uint32_t stream, WordsOfDraws& words);
/// The same in a file with flags of its own: only where the machine has AVX2.
void philox_avx2(std::uint64_t seed, std::uint64_t first_draw, std::uint32_t block,
                 std::uint32_t stream, WordsOfDraws& words);

/// floor(3 w / 2^32) - 1.
int ternary_level(std::uint32_t word);
/// (w + 0.5) / 2^31 - 1, on (-1, 1).
double uniform_share(std::uint32_t word);

/// Whether the generator gives the published known answers (Random123's, and seed 1 draw 0).
bool random_numbers_as_published();

}  // namespace misalign::search
