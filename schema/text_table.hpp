// Rows of words and numbers, one below the other.
#pragma once

#include <string>
#include <vector>

namespace misalign::schema {

/// Columns that a text (UTF-8) takes on a terminal: none for what is put on the letter before it,
/// two for the wide letters of East Asia.
std::size_t display_width(const std::string& text);

using Row = std::vector<std::string>;

/// Columns two apart; the numeric ones flush right. No blanks at the ends of lines. Cells and names
/// of columns may come from anywhere: they are made printable, so that a row is one line.
std::string aligned(const std::vector<Row>& cells, const std::vector<bool>& numeric);

/// A cell of CSV: in quotes where it needs them (RFC 4180).
std::string csv_cell(const std::string& text);

}  // namespace misalign::schema
