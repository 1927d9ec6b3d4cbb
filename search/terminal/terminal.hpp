// Writes everything that goes to standard output, with colors and the pager.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "schema/files/input.hpp"

namespace misalign::search {

enum class ColorMode { automatic, always, never };

/// Follows `mode`; `automatic` means colors on an able terminal, unless NO_COLOR is set.
bool colors_wanted(ColorMode mode, bool to_terminal);

/// Marks words, or returns them unchanged.
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

/// Sets the value of --color; called once, before any output.
void set_color_mode(ColorMode mode);
Paint paint_for(int file);

/// Returns $PAGER, or less if it is not set; empty, for no pager, if it is empty or cat.
std::string pager_command();

// Four functions write to standard output, and nothing else does (scripts/check.sh checks). Names
// and cells of a file may hold sequences that move a cursor, erase or color: they are escaped, also
// in a pipe, which may end in a terminal.

/// Writes text for people; Paint's colors stay if they are wanted. Text of a file must pass
/// schema::printable first, since line feeds are kept.
void put(const std::string& text);
/// Does the same with a format of fmt and its arguments.
template <class First, class... Others>
void put(fmt::format_string<First, Others...> format, First&& first, Others&&... others) {
  put(fmt::format(format, std::forward<First>(first), std::forward<Others>(others)...));
}
/// Writes JSON for programs, escaped in JSON's way, so that nothing is lost.
void put_json(const schema::Json& json, int indent = 1);
void put_json(const std::string& json);
/// Writes CSV for programs: unchanged, but escaped on a terminal, where people read it.
void put_csv(const std::string& rows);

/// Writes output of another process of this program, unchanged and at once.
void put_through(std::string_view bytes);

/// Writes as put does, through the pager if standard output is a terminal and `paged`.
class Show {
 public:
  explicit Show(bool paged);
  /// Waits until the pager ends.
  ~Show();
  Show(const Show&) = delete;
  Show& operator=(const Show&) = delete;
  /// Returns false once the user has quit the pager.
  bool write(const std::string& text);

 private:
  bool close_pager();

  std::FILE* pager_ = nullptr;
  void (*on_interrupt_)(int) = nullptr;
  void (*on_pipe_)(int) = nullptr;
  std::string begin_;  // shown without a pager if there turns out to be none
  bool was_left_ = false;
};

/// Returns whether the reader of standard output is gone, such as head or a pager.
bool reader_has_gone();

}  // namespace misalign::search
