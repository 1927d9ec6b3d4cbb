// Suggests a known word for a misspelt one.
#pragma once

#include <string>
#include <vector>

namespace misalign::schema {

/// Returns the known word that `typed` is nearest to: its beginning, whole words of it (friction of
/// critical_friction), or some letters off (one in three); empty if there is none.
std::string nearest_word(const std::string& typed, const std::vector<std::string>& known);

/// Returns "; did you mean A or B?" with the names, of several words, that hold `typed` in any case
/// of letters, at most three, or else the nearest; empty if there is none.
std::string meant_names(const std::string& typed, const std::vector<std::string>& names);

/// Returns "serch is no verb (did you mean search?)".
std::string unknown_word(const std::string& typed, const std::string& kind,
                         const std::vector<std::string>& known);

}  // namespace misalign::schema
