// Converts bytes to and from base64 (RFC 4648); numbers little-endian.
#pragma once

#include <bit>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace misalign::schema {

std::string base64(const unsigned char* bytes, std::size_t count);

/// Returns the bytes of a text; none unless base64() makes exactly this text of them.
std::optional<std::string> from_base64(std::string_view text);

template <class Number>
std::string base64(const std::vector<Number>& numbers) {
  static_assert(std::endian::native == std::endian::little);
  return base64(reinterpret_cast<const unsigned char*>(numbers.data()),
                numbers.size() * sizeof(Number));
}

}  // namespace misalign::schema
