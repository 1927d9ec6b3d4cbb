#include "search/terminal/shell_word.hpp"

namespace misalign::search {

std::string in_quotes(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

std::string shell_word(const std::string& text) {
  const bool plain =
      !text.empty() &&
      text.find_first_not_of(
          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./+,:@%") ==
          std::string::npos;
  return plain ? text : in_quotes(text);
}

std::string shell_path(const std::string& path) {
  return shell_word((path.starts_with('-') ? "./" : "") + path);
}

}  // namespace misalign::search
