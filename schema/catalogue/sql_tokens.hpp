// Splits SQL into SQLite's tokens: to compare texts, and to check that a text cannot end the SQL
// round it.
#pragma once

#include <string>
#include <vector>

namespace misalign::schema {

struct SqlTokens {
  std::vector<std::string> tokens;  ///< no blanks and comments
  std::vector<std::size_t> begins;  ///< begin of each token in the text
  /// True if the text ends in an unclosed string, quoted name or comment, so that text after it
  /// would change its meaning. Also true with a zero byte, at which SQLite stops reading.
  bool is_open = false;
};

SqlTokens sql_tokens(const std::string& sql);

/// Returns why `sql` cannot stand within brackets as one expression: "ends a bracket that it did
/// not open". Empty if it can, as far as its tokens tell.
std::string reason_not_to_enclose(const std::string& sql);

}  // namespace misalign::schema
