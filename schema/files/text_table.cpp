#include "schema/files/text_table.hpp"

#include <algorithm>
#include <cassert>
#include <string_view>

#include "schema/files/printable.hpp"
#include "schema/files/utf8.hpp"

namespace misalign::schema {
namespace {

// Combining characters by whole blocks of Unicode: exact enough for names in a table.
constexpr CharacterRange kOnTheLetterBefore[] = {{0x300, 0x36f},   {0x483, 0x489},
                                                 {0x1ab0, 0x1aff}, {0x200b, 0x200f},
                                                 {0x20d0, 0x20ff}, {0xfe00, 0xfe0f}};
constexpr CharacterRange kWide[] = {{0x1100, 0x115f},   {0x2e80, 0xa4cf},  {0xac00, 0xd7a3},
                                    {0xf900, 0xfaff},   {0xfe30, 0xfe6f},  {0xff00, 0xff60},
                                    {0x1f300, 0x1faff}, {0x20000, 0x3fffd}};

}  // namespace

std::size_t display_width(const std::string& text) {
  std::size_t width = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const Utf8Character c = first_character(rest);
    width += is_within(kOnTheLetterBefore, c.code) ? 0 : is_within(kWide, c.code) ? 2 : 1;
    rest.remove_prefix(c.bytes);
  }
  return width;
}

void Columns::widen(const Row& row) {
  for (std::size_t k = 0; k < row.size(); ++k) {
    assert(k < width_.size());
    width_[k] = std::max(width_[k], display_width(row[k]));
  }
}

std::string Columns::line(const Row& row) const {
  std::string line;
  for (std::size_t k = 0; k < row.size(); ++k) {
    assert(k < width_.size() && k < numeric_.size());
    const std::size_t cell_width = display_width(row[k]);
    const std::string pad(width_[k] - std::min(width_[k], cell_width), ' ');
    line += (k ? "  " : "") + (numeric_[k] ? pad + row[k] : row[k] + pad);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

Row printable_row(Row row) {
  for (std::string& cell : row) cell = printable(cell);
  return row;
}

std::string aligned(const std::vector<Row>& cells, const std::vector<bool>& numeric) {
  std::vector<Row> rows;
  for (const Row& row : cells) rows.push_back(printable_row(row));
  Columns columns(numeric);
  for (const Row& row : rows) columns.widen(row);
  std::string text;
  for (const Row& row : rows) text += columns.line(row);
  return text;
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace misalign::schema
