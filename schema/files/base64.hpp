// Numbers as base64 (RFC 4648) of their bytes, little-endian.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace misalign::schema {

std::string base64(const unsigned char* bytes, std::size_t count);

template <class Number>
std::string base64(const std::vector<Number>& numbers) {
  static_assert(std::endian::native == std::endian::little);
  return base64(reinterpret_cast<const unsigned char*>(numbers.data()),
                numbers.size() * sizeof(Number));
}

}  // namespace misalign::schema
