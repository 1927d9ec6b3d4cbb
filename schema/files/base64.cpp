#include "schema/files/base64.hpp"

namespace misalign::schema {

std::string base64(const unsigned char* bytes, std::size_t count) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((count + 2) / 3 * 4);
  for (std::size_t k = 0; k < count; k += 3) {
    const std::size_t left = count - k;
    const std::uint32_t three = std::uint32_t{bytes[k]} << 16 |
                                (left > 1 ? std::uint32_t{bytes[k + 1]} << 8 : 0) |
                                (left > 2 ? std::uint32_t{bytes[k + 2]} : 0);
    text += kDigits[three >> 18];
    text += kDigits[three >> 12 & 63];
    text += left > 1 ? kDigits[three >> 6 & 63] : '=';
    text += left > 2 ? kDigits[three & 63] : '=';
  }
  return text;
}

}  // namespace misalign::schema
