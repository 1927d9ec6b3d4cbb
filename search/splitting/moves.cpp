#include "search/splitting/moves.hpp"

#include <bit>
#include <cassert>

#include "search/draws/draw.hpp"

namespace misalign::search {

StepWords::StepWords(std::uint64_t seed, std::uint32_t population, std::uint32_t level,
                     std::uint32_t step, std::uint32_t particle)
    : seed_(seed),
      counter_low_(population | static_cast<std::uint64_t>(particle) << 32),
      step_(step << 16),
      stream_(level << 8 | kSplittingStream) {}

std::uint32_t StepWords::next() {
  assert(used_ / 4 < 1u << 16);  // the block's number has 16 bits of the counter
  const std::uint32_t at = used_ % 4;
  if (at == 0) block_ = philox_block(seed_, counter_low_, step_ | used_ / 4, stream_);
  ++used_;
  return block_[at];
}

std::size_t StepWords::next_below(std::size_t count) {
  assert(count > 0);
  return static_cast<std::size_t>((static_cast<std::uint64_t>(next()) * count) >> 32);
}

Moves::Moves(const schema::Campaign& campaign)
    : code_(campaign.misalignment),
      symmetries_(solver::shift_symmetries(campaign.pattern.base, campaign.misalignment.vertices)) {
}

void Moves::draw(StepWords words, ShiftCode::Particle sheet) const {
  for (std::size_t k = 0; k < code_.shifts(); ++k) code_.draw(sheet, k, words.next());
}

void Moves::propose(StepWords words, ShiftCode::Particle sheet) const {
  constexpr std::uint32_t kOneInSixteen = 15;
  const std::uint32_t kind = words.next();
  if (!symmetries_.empty() && (kind & kOneInSixteen) == 0) {
    mirror(symmetries_[words.next_below(symmetries_.size())], sheet);
    return;
  }
  const int more = std::countr_zero(kind >> 4 | 1u << 27);
  for (int n = 0; n <= more; ++n) {
    const std::size_t k = words.next_below(code_.shifts());
    code_.redraw(sheet, k, words.next());
  }
}

void Moves::mirror(const solver::ShiftSymmetry& symmetry, ShiftCode::Particle sheet) const {
  assert(symmetry.from.size() == code_.shifts() && symmetry.negated.size() == code_.shifts());
  const std::vector<std::uint8_t> before(sheet.begin(), sheet.end());
  for (std::size_t k = 0; k < code_.shifts(); ++k) {
    code_.copy(sheet, k, before, static_cast<std::size_t>(symmetry.from[k]), symmetry.negated[k]);
  }
}

}  // namespace misalign::search
