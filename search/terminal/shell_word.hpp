// Quotes texts so that a shell takes each as one word.
#pragma once

#include <string>

namespace misalign::search {

/// Returns the text in single quotes.
std::string in_quotes(const std::string& text);
/// Returns the text unchanged if a shell takes it literally; else in quotes.
std::string shell_word(const std::string& text);
/// Does the same for a file's name, which must not look like an option: "./-x.db".
std::string shell_path(const std::string& path);

}  // namespace misalign::search
