// Writes bytes as hexadecimal digits.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace misalign::schema {

inline constexpr std::string_view kHexDigits = "0123456789abcdef";

/// Returns two digits for each byte.
inline std::string hex(std::span<const unsigned char> bytes) {
  std::string digits;
  for (const unsigned char byte : bytes) {
    digits += kHexDigits[byte >> 4];
    digits += kHexDigits[byte & 15];
  }
  return digits;
}

}  // namespace misalign::schema
