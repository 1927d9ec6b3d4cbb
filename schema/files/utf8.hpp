// Decodes UTF-8 of unknown origin, character by character.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace misalign::schema {

struct Utf8Character {
  char32_t code;
  std::size_t bytes;    ///< that it takes; 1 where it is none
  bool is_utf8 = true;  ///< false: no character begins here, and `code` is the byte
};

/// The first character of a text that is not empty: shortest forms only, no halves of pairs
/// (RFC 3629).
Utf8Character first_character(std::string_view text);

/// Characters from one to another, both included.
struct CharacterRange {
  char32_t first, last;
};
bool is_within(std::span<const CharacterRange> ranges, char32_t code);

}  // namespace misalign::schema
