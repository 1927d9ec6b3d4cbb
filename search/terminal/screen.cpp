#include "search/terminal/screen.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace misalign::search {
namespace {

std::atomic<bool> line_is_live = false;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

bool is_terminal(int file) { return isatty(file) == 1; }

int terminal_width(int file) {
  winsize size{};
  if (ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  const int columns = std::atoi(environment("COLUMNS").c_str());
  return columns > 0 ? columns : 80;
}

bool terminal_is_able() {
  const std::string name = environment("TERM");
  return !name.empty() && name != "dumb";
}

bool locale_is_utf8() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    std::string locale = environment(name);
    if (locale.empty()) continue;  // the first that is set counts
    std::erase(locale, '-');
    std::transform(locale.begin(), locale.end(), locale.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return locale.find("utf8") != std::string::npos;
  }
  return false;
}

// Returns to the start of the line, writes the text, and erases the rest of a longer one.
void draw_live_line(const std::string& text) {
  std::fputs(("\r" + text + "\x1b[K").c_str(), stderr);
  std::fflush(stderr);
  line_is_live = true;
}

void leave_live_line() {
  if (line_is_live.exchange(false) && write(STDERR_FILENO, "\n", 1) < 0)
    return;  // a closed terminal
}

void erase_live_line() {
  if (!line_is_live.exchange(false)) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
}

}  // namespace misalign::search
