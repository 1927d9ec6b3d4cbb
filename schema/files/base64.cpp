#include "schema/files/base64.hpp"

namespace misalign::schema {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string base64(const unsigned char* bytes, std::size_t count) {
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

std::optional<std::string> from_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t k = 0; k < text.size(); k += 4) {
    std::uint32_t three = 0;
    std::size_t digits = 0;
    for (; digits < 4 && text[k + digits] != '='; ++digits) {
      const std::size_t digit = kDigits.find(text[k + digits]);
      if (digit == std::string_view::npos) return std::nullopt;
      three |= static_cast<std::uint32_t>(digit) << (18 - 6 * digits);
    }
    if (digits < 2) return std::nullopt;
    for (std::size_t byte = 0; byte + 1 < digits; ++byte) {
      bytes += static_cast<char>(three >> (16 - 8 * byte) & 0xff);
    }
  }
  // Unused bits of the last digit, or text after a '=', would give a second text of the same bytes.
  if (base64(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()) != text) {
    return std::nullopt;
  }
  return bytes;
}

}  // namespace misalign::schema
