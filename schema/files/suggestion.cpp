#include "schema/files/suggestion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

#include "schema/files/printable.hpp"

namespace misalign::schema {
namespace {

// Returns the number of letters to add, leave out, change, or swap with their neighbour.
std::size_t letters_off(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> off(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        off[i][j] = i + j;
        continue;
      }
      const bool same = a[i - 1] == b[j - 1];
      off[i][j] =
          std::min({off[i - 1][j] + 1, off[i][j - 1] + 1, off[i - 1][j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        off[i][j] = std::min(off[i][j], off[i - 2][j - 2] + 1);
      }
    }
  }
  return off[a.size()][b.size()];
}

// Returns whether `typed` is the beginning of `word`, or whole words of it.
bool is_part(const std::string& typed, const std::string& word) {
  if (typed.size() <= 2) return false;
  const std::size_t at = word.find(typed), end = at + typed.size();
  if (at == std::string::npos) return false;
  const auto divides = [&](std::size_t k) { return word[k] == '_' || word[k] == '-'; };
  return at == 0 || (divides(at - 1) && (end == word.size() || divides(end)));
}

std::string in_small_letters(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

std::string nearest_word(const std::string& typed, const std::vector<std::string>& known) {
  std::string nearest;
  std::size_t fewer_than = typed.size() / 3 + 1;
  for (const std::string& word : known) {
    const std::size_t off = is_part(typed, word) ? 1 : letters_off(typed, word);
    if (off >= fewer_than) continue;
    fewer_than = off;
    nearest = word;
  }
  return nearest;
}

std::string meant_names(const std::string& typed, const std::vector<std::string>& names) {
  constexpr std::size_t kMostMeant = 3, kLeastLetters = 3;
  const std::string small = in_small_letters(typed);
  std::vector<std::string> meant, small_names;
  for (const std::string& name : names) {
    small_names.push_back(in_small_letters(name));
    const bool holds =
        small.size() >= kLeastLetters && small_names.back().find(small) != std::string::npos;
    if (holds && meant.size() < kMostMeant) meant.push_back(name);
  }
  if (meant.empty()) {
    const auto nearest = std::ranges::find(small_names, nearest_word(small, small_names));
    if (nearest == small_names.end()) return "";
    meant.push_back(names[static_cast<std::size_t>(nearest - small_names.begin())]);
  }
  return fmt::format("; did you mean {}?", fmt::join(meant, " or "));
}

std::string unknown_word(const std::string& typed, const std::string& kind,
                         const std::vector<std::string>& known) {
  const std::string meant = nearest_word(typed, known);
  return printable(utf8(typed)) + " is no " + kind +
         (meant.empty() ? "" : " (did you mean " + meant + "?)");
}

}  // namespace misalign::schema
