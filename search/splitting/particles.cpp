#include "search/splitting/particles.hpp"

#include <cassert>
#include <cstring>

#include "search/draws/draw.hpp"

namespace misalign::search {

ShiftCode::ShiftCode(const schema::Misalignment& misalignment)
    : distribution_(misalignment.distribution),
      amplitude_mm_(misalignment.amplitude_mm),
      shifts_(2 * misalignment.vertices.size()),
      width_(misalignment.distribution == schema::ShiftDistribution::ternary
                 ? 1
                 : sizeof(std::uint32_t)) {}

std::uint32_t ShiftCode::code(ConstParticle sheet, std::size_t k) const {
  assert(k < shifts_);
  if (is_ternary()) return sheet[k];
  std::uint32_t word;
  std::memcpy(&word, sheet.data() + k * width_, width_);
  return word;
}

void ShiftCode::set(Particle sheet, std::size_t k, std::uint32_t code) const {
  assert(k < shifts_ && (!is_ternary() || code < 3));
  if (is_ternary()) {
    sheet[k] = static_cast<std::uint8_t>(code);
  } else {
    std::memcpy(sheet.data() + k * width_, &code, width_);
  }
}

void ShiftCode::draw(Particle sheet, std::size_t k, std::uint32_t word) const {
  set(sheet, k, is_ternary() ? static_cast<std::uint32_t>(ternary_level(word) + 1) : word);
}

void ShiftCode::redraw(Particle sheet, std::size_t k, std::uint32_t word) const {
  set(sheet, k, is_ternary() ? (code(sheet, k) + 1 + (word & 1)) % 3 : word);
}

void ShiftCode::copy(Particle sheet, std::size_t k, ConstParticle source, std::size_t from,
                     bool negated) const {
  const std::uint32_t value = code(source, from);
  const std::uint32_t opposite = is_ternary() ? 2 - value : ~value;
  set(sheet, k, negated ? opposite : value);
}

void ShiftCode::write_mm(ConstParticle sheet, double* shifts_mm) const {
  for (std::size_t k = 0; k < shifts_; ++k) {
    const std::uint32_t value = code(sheet, k);
    shifts_mm[k] =
        amplitude_mm_ * (is_ternary() ? static_cast<int>(value) - 1.0 : uniform_share(value));
  }
}

}  // namespace misalign::search
