// Quotes texts so that a shell takes each as one word.
#pragma once

#include <string>

namespace misalign::search {

/// In single quotes, whatever it is.
std::string in_quotes(const std::string& text);
/// As it is where no shell would see more in it; else in quotes.
std::string shell_word(const std::string& text);
/// The same of a file's name, which no program takes for an option: "./-x.db".
std::string shell_path(const std::string& path);

}  // namespace misalign::search
