#include "search/terminal/terminal.hpp"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "search/terminal/long_work.hpp"
#include "search/terminal/screen.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {
namespace {

ColorMode color_mode = ColorMode::automatic;

constexpr const char *kBold = "1", *kGood = "32", *kBad = "31", *kEnd = "0";

std::string mark(const char* code) { return std::string("\x1b[") + code + "m"; }

// The length in bytes of a Paint mark at the start of the text; 0 without one.
std::size_t mark_at(std::string_view text) {
  for (const char* code : {kBold, kGood, kBad, kEnd}) {
    if (text.starts_with(mark(code))) return mark(code).size();
  }
  return 0;
}

std::string for_people(std::string_view text) {
  if (!paint_for(STDOUT_FILENO).is_on()) return schema::printable_lines(text);
  std::string shown;
  while (!text.empty()) {  // one mark or text between marks
    const std::size_t marked = mark_at(text);
    const std::size_t end = marked > 0 ? marked : std::min(text.find('\x1b', 1), text.size());
    const std::string_view part = text.substr(0, end);
    shown += marked > 0 ? std::string(part) : schema::printable_lines(part);
    text.remove_prefix(end);
  }
  return shown;
}

void write_out(std::string_view text) {
  static Stopwatch since_flush;
  if (is_terminal(STDOUT_FILENO)) end_shown_work();  // the output shows the progress
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (since_flush.seconds() < 1) return;  // slow rows are flushed one by one
  std::fflush(stdout);
  since_flush = Stopwatch();
}

}  // namespace

bool colors_wanted(ColorMode mode, bool to_terminal) {
  if (mode != ColorMode::automatic) return mode == ColorMode::always;
  const char* const no_color = std::getenv("NO_COLOR");
  return to_terminal && terminal_is_able() && !(no_color && *no_color);
}

std::string Paint::marked(const char* code, const std::string& text) const {
  return on_ ? mark(code) + text + mark(kEnd) : text;
}

std::string Paint::bold(const std::string& text) const { return marked(kBold, text); }
std::string Paint::good(const std::string& text) const { return marked(kGood, text); }
std::string Paint::bad(const std::string& text) const { return marked(kBad, text); }

void set_color_mode(ColorMode mode) { color_mode = mode; }

Paint paint_for(int file) { return Paint(colors_wanted(color_mode, is_terminal(file))); }

std::string pager_command() {
  const char* chosen = std::getenv("PAGER");
  const std::string command = chosen ? chosen : "less";
  return command == "cat" ? "" : command;
}

void put(const std::string& text) { write_out(for_people(text)); }

void put_json(const schema::Json& json, int indent) {
  put_json(json.dump(indent, ' ', false, schema::Json::error_handler_t::replace) + "\n");
}

void put_json(const std::string& json) { write_out(schema::printable_json(json)); }

void put_csv(const std::string& rows) {
  write_out(is_terminal(STDOUT_FILENO) ? schema::printable_csv(rows) : rows);
}

void put_through(std::string_view bytes) {
  write_out(bytes);
  std::fflush(stdout);
}

Show::Show(bool paged) {
  const std::string command = paged && is_terminal(STDOUT_FILENO) ? pager_command() : "";
  std::fflush(stdout);
  if (command.empty()) return;
  end_shown_work();
  // git's options: exit if all fits, keep colors, cut long lines, leave the screen unchanged.
  setenv("LESS", "FRSX", /*overwrite=*/0);
  pager_ = popen(command.c_str(), "w");
  if (!pager_) return;
  // The pager handles Ctrl-C, and may quit before it has read everything. Set after popen, since
  // the pager would inherit it.
  on_interrupt_ = std::signal(SIGINT, SIG_IGN);
  on_pipe_ = std::signal(SIGPIPE, SIG_IGN);
}

Show::~Show() {
  if (pager_ && close_pager()) write_out(begin_);
}

// Returns whether the pager did not exist; then nothing was shown.
bool Show::close_pager() {
  const int status = pclose(pager_);
  pager_ = nullptr;
  std::signal(SIGINT, on_interrupt_);
  std::signal(SIGPIPE, on_pipe_);
  return WIFEXITED(status) && (WEXITSTATUS(status) == 126 || WEXITSTATUS(status) == 127);
}

bool Show::write(const std::string& text) {
  constexpr std::size_t kMoreThanAPipeHolds = 1 << 20;
  if (was_left_) return false;
  const std::string shown = for_people(text);
  if (pager_) {
    if (begin_.size() < kMoreThanAPipeHolds) begin_ += shown;
    if (std::fputs(shown.c_str(), pager_) >= 0 && std::fflush(pager_) == 0) return true;
    was_left_ = !close_pager();
    if (was_left_) return false;
  }
  write_out(pager_ || begin_.empty() ? shown : std::exchange(begin_, ""));
  return std::ferror(stdout) == 0;
}

bool reader_has_gone() {
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  return poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

}  // namespace misalign::search
