// Decodes UTF-8 of unknown origin, character by character.
#pragma once

#include <cstddef>
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

}  // namespace misalign::schema
