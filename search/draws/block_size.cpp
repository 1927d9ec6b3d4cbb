#include "search/draws/block_size.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::search {
namespace {

constexpr std::uint64_t kMostSheets = 4096;      // 2.6 MB on 6 x 6: larger ones are slower
constexpr std::uint64_t kMostNumbers = 1 << 21;  // shifts and diagonals of a block: 16 MB
constexpr double kShort_s = 0.015, kLong_s = 0.08;

}  // namespace

std::uint64_t largest_block(const solver::Model& model) {
  const std::uint64_t numbers = 2 * model.shifted().size() + 3 * model.mechanism().diagonals.size();
  assert(numbers > 0);
  return std::clamp<std::uint64_t>(kMostNumbers / numbers, 8, kMostSheets);
}

void BlockSize::took(double seconds) {
  assert(now_ >= 1 && now_ <= most_);
  if (seconds < kShort_s) now_ = std::min(2 * now_, most_);
  if (seconds > kLong_s) now_ = std::max<std::uint64_t>(now_ / 2, 1);
}

}  // namespace misalign::search
