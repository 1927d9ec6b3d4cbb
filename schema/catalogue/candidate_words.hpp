// Words that stand for a number of a candidate: its columns, and functions of its sheet.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>
#include <vector>

namespace misalign::schema {

/// Returns the columns of the view `candidates`.
std::vector<std::string> columns_of_candidates(SQLite::Database& database);
/// Returns these columns and the functions of a sheet.
std::vector<std::string> words_of_candidates(const std::vector<std::string>& columns);

/// Returns "; did you mean stroke_max?", or an empty text.
std::string column_meant(const std::string& typed, const std::vector<std::string>& columns);

/// The unknown name in an error of SQLite.
struct UnknownWord {
  const char* kind;  ///< "column" or "function"; null for any other error
  std::string typed;
};
UnknownWord unknown_word_of(const std::string& refused);

}  // namespace misalign::schema
