// Colors, the pager, and everything that goes to standard output.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "schema/files/input.hpp"

namespace misalign::search {

enum class ColorMode { automatic, always, never };

/// As `mode` says; else only to an able terminal, and never with NO_COLOR set.
bool colors_wanted(ColorMode mode, bool to_terminal);

/// Marks words, or leaves them as they are.
class Paint {
 public:
  explicit Paint(bool on) : on_(on) {}
  bool is_on() const { return on_; }
  std::string bold(const std::string& text) const;
  std::string good(const std::string& text) const;
  std::string bad(const std::string& text) const;

 private:
  std::string marked(const char* code, const std::string& text) const;
  bool on_;
};

/// What --color said; once, before anything is shown.
void set_color_mode(ColorMode mode);
Paint paint_for(int file);

/// $PAGER, without one less; empty if that is empty or cat: then nothing is paged.
std::string pager_command();

// Everything that goes to standard output, in four ways; nothing else writes there
// (scripts/check.sh looks). Names and cells of a file may hold whatever moves a cursor, erases or
// colors: it is escaped, also in a pipe, which a terminal may be the end of.

/// Text for people. Colors of Paint stay where they are wanted. Whoever puts text of a file in says
/// schema::printable to it: a line feed stays here.
void put(const std::string& text);
/// The same, of a format of fmt and what fills it.
template <class First, class... Others>
void put(fmt::format_string<First, Others...> format, First&& first, Others&&... others) {
  put(fmt::format(format, std::forward<First>(first), std::forward<Others>(others)...));
}
/// JSON for programs: escaped in JSON's own way, so that nothing is lost.
void put_json(const schema::Json& json, int indent = 1);
void put_json(const std::string& json);
/// CSV for programs: as it is, but escaped on a terminal, where nobody but people reads it.
void put_csv(const std::string& rows);

/// What another process of this program has made of the three above: as it is, and at once.
void put_through(std::string_view bytes);

/// As put, through the pager if standard output is a terminal and `paged`.
class Show {
 public:
  explicit Show(bool paged);
  /// Waits for whoever reads in the pager.
  ~Show();
  Show(const Show&) = delete;
  Show& operator=(const Show&) = delete;
  /// False if the pager was left: then nobody reads what may follow.
  bool write(const std::string& text);

 private:
  bool close_pager();

  std::FILE* pager_ = nullptr;
  void (*on_interrupt_)(int) = nullptr;
  void (*on_pipe_)(int) = nullptr;
  std::string begin_;  // for a pager that is not there, which is known when it has ended
  bool was_left_ = false;
};

/// Whether nobody reads standard output any more: a pager that was left, a head that has enough.
bool reader_has_gone();

}  // namespace misalign::search
