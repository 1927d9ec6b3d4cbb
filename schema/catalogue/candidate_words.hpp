// Words that stand for a number of a candidate: its columns, and functions of its sheet.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>
#include <vector>

namespace misalign::schema {

/// Of the view `candidates`.
std::vector<std::string> columns_of_candidates(SQLite::Database& database);
/// These, and functions of a sheet.
std::vector<std::string> words_of_candidates(const std::vector<std::string>& columns);

/// "; did you mean stroke_max?", or nothing.
std::string column_meant(const std::string& typed, const std::vector<std::string>& columns);

/// A word that SQLite refuses, in its words.
struct UnknownWord {
  const char* kind;  ///< "column" or "function"; null: it refuses something else
  std::string typed;
};
UnknownWord unknown_word_of(const std::string& refused);

}  // namespace misalign::schema
