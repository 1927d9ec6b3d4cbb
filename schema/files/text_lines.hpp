// Splits text into lines of words, and words into numbers, for formats of lines.
#pragma once

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

namespace misalign::schema {

using Words = std::vector<std::string_view>;

/// Returns the words of a line, without a comment from "#" on.
Words words_of(std::string_view line);

/// Calls `see` with the words of each line that is not empty, until it returns false.
template <class See>
void each_line(std::string_view text, const See& see) {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const Words words = words_of(text.substr(begin, end - begin));
    if (!words.empty() && !see(words)) return;
    begin = end + 1;
  }
}

/// Returns a word as a number if it is one, also "+1", "nan" and "inf".
template <class Number>
std::optional<Number> number_of(std::string_view word) {
  Number number{};
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

}  // namespace misalign::schema
