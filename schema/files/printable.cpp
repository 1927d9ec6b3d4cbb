#include "schema/files/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "schema/files/utf8.hpp"

namespace misalign::schema {
namespace {

// Characters that control a terminal, or hide or reverse their neighbours: controls; Arabic letter
// mark, marks and embeddings of direction; separators of lines; isolates and deprecated format
// characters; byte order mark; annotation; tags.
constexpr CharacterRange kEscaped[] = {
    {0x00, 0x1f},     {0x7f, 0x9f},     {0x61c, 0x61c},   {0x180e, 0x180e}, {0x200e, 0x200f},
    {0x2028, 0x202e}, {0x2060, 0x206f}, {0xfeff, 0xfeff}, {0xfff9, 0xfffb}, {0xe0000, 0xe0fff}};

void append_escape(std::string& shown, char32_t code) {
  const auto append = [&](std::uint32_t unit) { shown += fmt::format("\\u{:04x}", unit); };
  if (code < 0x10000) return append(code);
  append(0xd800 + ((code - 0x10000) >> 10));  // a pair, as in JSON
  append(0xdc00 + ((code - 0x10000) & 0x3ff));
}

// Escapes a text; `keeps(c)` exempts a character from escaping.
template <class Keeps>
std::string escaped(std::string_view text, Keeps keeps) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character c = first_character(text);
    if (!c.is_utf8) {
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    } else if (is_within(kEscaped, c.code) && !keeps(c.code)) {
      append_escape(shown, c.code);
    } else {
      shown.append(text.substr(0, c.bytes));
    }
    text.remove_prefix(c.bytes);
  }
  return shown;
}

}  // namespace

std::string printable(std::string_view text) {
  return escaped(text, [](char32_t) { return false; });
}

std::string printable_lines(std::string_view text) {
  return escaped(text, [](char32_t c) { return c == '\n'; });
}

std::string printable_json(std::string_view json) { return printable_lines(json); }

std::string printable_csv(std::string_view rows) {
  std::string shown;
  bool quoted = false;
  while (!rows.empty()) {  // from quote to quote
    const std::size_t quote = std::min(rows.find('"'), rows.size());
    const std::string_view part = rows.substr(0, quote);
    shown += quoted ? printable(part) : printable_lines(part);
    if (quote < rows.size()) shown += '"';
    quoted = !quoted;
    rows.remove_prefix(std::min(quote + 1, rows.size()));
  }
  return shown;
}

std::string shortened(const std::string& text, std::size_t most) {
  assert(most > 3);  // the dots
  if (text.size() <= most) return text;
  const auto continues = [&](std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
  };
  std::size_t head = (most - 3) * 2 / 3, tail = text.size() - (most - 3 - head);
  while (head > 0 && continues(head)) --head;
  while (continues(tail)) ++tail;
  return text.substr(0, head) + "..." + text.substr(tail);
}

std::string utf8(const std::string& text) {
  using nlohmann::json;
  const std::string replaced = json(text).dump(-1, ' ', false, json::error_handler_t::replace);
  return json::parse(replaced).get<std::string>();
}

}  // namespace misalign::schema
