// What is known of the terminal, and what may be shown there.
#pragma once

#include <string>

namespace misalign::search {

enum class ColorWish { automatic, always, never };

bool is_terminal(int file);
/// Columns of the terminal behind a file; 80 where there is none, or where it does not say.
int terminal_width(int file);
/// Whether TERM names a terminal that can go back within a line, erase and color.
bool terminal_is_able();
/// Whether the locale's characters are UTF-8.
bool locale_is_utf8();

/// As wished; else only to an able terminal, and never with NO_COLOR set.
bool colors_wanted(ColorWish wish, bool to_terminal);

/// Marks words, or leaves them as they are.
class Paint {
 public:
  explicit Paint(bool on) : on_(on) {}
  std::string bold(const std::string& text) const { return marked("1", text); }
  std::string dim(const std::string& text) const { return marked("2", text); }
  std::string good(const std::string& text) const { return marked("32", text); }
  std::string bad(const std::string& text) const { return marked("31", text); }

 private:
  std::string marked(const char* code, const std::string& text) const;
  bool on_;
};

/// What --color said; once, before anything is shown.
void wish_colors(ColorWish wish);
Paint paint_for(int file);

/// $PAGER, without one less; empty if that is empty or cat: then nothing is paged.
std::string pager_command();
/// Writes to standard output, through the pager if that is a terminal and `paged`.
void show(const std::string& text, bool paged);

/// Whether nobody reads standard output any more: a pager that was left, a head that has enough.
bool reader_has_gone();

}  // namespace misalign::search
