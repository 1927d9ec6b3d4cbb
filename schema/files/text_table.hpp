// Aligned tables of words and numbers, as text.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace misalign::schema {

/// Columns that a text (UTF-8) takes on a terminal: none for what is put on the letter before it,
/// two for the wide letters of East Asia.
std::size_t display_width(const std::string& text);

using Row = std::vector<std::string>;

/// The widths of a table's columns, known from its rows; row after row can be written then.
class Columns {
 public:
  explicit Columns(std::vector<bool> numeric) : numeric_(std::move(numeric)) {}

  void widen(const Row& row);
  void set_text(std::size_t column) { numeric_[column] = false; }
  /// Columns two apart; the numeric ones flush right. No blanks at the end, then a line break. What
  /// is wider than its column moves the rest of its line.
  std::string line(const Row& row) const;

 private:
  std::vector<bool> numeric_;
  std::vector<std::size_t> width_ = std::vector<std::size_t>(numeric_.size(), 0);
};

/// Cells and names of columns may come from anywhere: made printable, a row is one line.
Row printable_row(Row row);

/// All rows of a small table, made printable, below each other.
std::string aligned(const std::vector<Row>& cells, const std::vector<bool>& numeric);

/// A cell of CSV: in quotes where it needs them (RFC 4180).
std::string csv_cell(const std::string& text);

}  // namespace misalign::schema
