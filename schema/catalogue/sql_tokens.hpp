// Splits SQL into the tokens that SQLite sees: to compare two texts, and to check that a text put
// into another cannot end what is round it.
#pragma once

#include <string>
#include <vector>

namespace misalign::schema {

struct SqlTokens {
  std::vector<std::string> tokens;  ///< without blanks and comments
  std::vector<std::size_t> begins;  ///< where each of them begins in the text
  /// Whether the text ends in a string, a quoted name or a comment that it does not close: then it
  /// means something else where more follows. Also with a zero byte, at which SQLite stops reading.
  bool is_open = false;
};

SqlTokens sql_tokens(const std::string& sql);

/// Why `sql` cannot stand between two brackets as one expression: "ends a bracket that it did not
/// open". Empty if it can, as far as its tokens tell.
std::string reason_not_to_enclose(const std::string& sql);

}  // namespace misalign::schema
