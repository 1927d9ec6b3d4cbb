// Decodes UTF-8 of unknown origin, character by character.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace misalign::schema {

struct Utf8Character {
  char32_t code;
  std::size_t bytes;    ///< bytes of the character; 1 if it is none
  bool is_utf8 = true;  ///< false: no valid character, and `code` is the byte
};

/// Decodes the first character of a text that is not empty: shortest forms only, no surrogates (RFC
/// 3629).
Utf8Character first_character(std::string_view text);

/// A range of characters, both ends included.
struct CharacterRange {
  char32_t first, last;
};
bool is_within(std::span<const CharacterRange> ranges, char32_t code);

}  // namespace misalign::schema
