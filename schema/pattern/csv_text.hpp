// Splits CSV (RFC 4180) into lines of cells.
#pragma once

#include <string>
#include <vector>

namespace misalign::schema {

struct CsvLine {
  std::size_t number;  ///< its first line in the file, from 1
  std::vector<std::string> cells;
};

/// Returns the lines with any text in a cell; cells without blanks at their ends, unless these are
/// quoted. Lines that begin with "#" are comments. A quotation that does not end takes the rest.
std::vector<CsvLine> csv_lines(const std::string& text);

}  // namespace misalign::schema
