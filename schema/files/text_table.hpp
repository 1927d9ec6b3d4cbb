// Writes aligned tables of words and numbers.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace misalign::schema {

/// Returns the columns of a terminal that a text (UTF-8) takes: none for combining characters, two
/// for wide East Asian letters.
std::size_t display_width(const std::string& text);

using Row = std::vector<std::string>;

/// The widths of a table's columns, found from its rows; then rows can be written one by one.
class Columns {
 public:
  explicit Columns(std::vector<bool> numeric) : numeric_(std::move(numeric)) {}

  void widen(const Row& row);
  void set_text(std::size_t column) { numeric_[column] = false; }
  /// Writes a row, its columns two apart and the numeric ones flush right, without blanks at the
  /// end, then a line break. A cell wider than its column shifts the rest of its line.
  std::string line(const Row& row) const;

 private:
  std::vector<bool> numeric_;
  std::vector<std::size_t> width_ = std::vector<std::size_t>(numeric_.size(), 0);
};

/// Makes cells of any origin printable, so that a row is one line.
Row printable_row(Row row);

/// Writes all rows of a small table, made printable.
std::string aligned(const std::vector<Row>& cells, const std::vector<bool>& numeric);

/// Returns a cell of CSV, in quotes where needed (RFC 4180).
std::string csv_cell(const std::string& text);

}  // namespace misalign::schema
