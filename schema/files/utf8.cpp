#include "schema/files/utf8.hpp"

#include <algorithm>
#include <array>

namespace misalign::schema {

Utf8Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const Utf8Character none{byte(0), 1, false};
  if (byte(0) < 0x80) return {byte(0), 1};
  const std::size_t bytes = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < bytes) return none;
  char32_t code = byte(0) & (0xffU >> (bytes + 1));
  for (std::size_t k = 1; k < bytes; ++k) {
    if ((byte(k) & 0xc0) != 0x80) return none;
    code = (code << 6) | (byte(k) & 0x3fU);
  }
  constexpr std::array<char32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_half = code >= 0xd800 && code <= 0xdfff;
  if (code < kLeast[bytes] || code > 0x10ffff || is_half) return none;
  return {code, bytes};
}

bool is_within(std::span<const CharacterRange> ranges, char32_t code) {
  return std::ranges::any_of(ranges, [code](const CharacterRange& range) {
    return code >= range.first && code <= range.last;
  });
}

}  // namespace misalign::schema
