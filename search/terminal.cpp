#include "search/terminal.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace misalign::search {
namespace {

ColorWish color_wish = ColorWish::automatic;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

// False if there is no such pager: then nothing was shown.
bool show_in_pager(const std::string& command, const std::string& text) {
  // As git does: end at once if all fits, colors, long lines cut, the screen left as it is.
  setenv("LESS", "FRSX", /*overwrite=*/0);
  std::FILE* pager = popen(command.c_str(), "w");
  if (!pager) return false;
  // Ctrl-C is the pager's, and it may be left before it has read everything. Only now: the pager
  // would inherit it.
  const auto on_interrupt = std::signal(SIGINT, SIG_IGN), on_pipe = std::signal(SIGPIPE, SIG_IGN);
  std::fputs(text.c_str(), pager);
  const int status = pclose(pager);
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGPIPE, on_pipe);
  const bool missing =
      WIFEXITED(status) && (WEXITSTATUS(status) == 126 || WEXITSTATUS(status) == 127);
  return !missing;
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

bool colors_wanted(ColorWish wish, bool to_terminal) {
  if (wish != ColorWish::automatic) return wish == ColorWish::always;
  return to_terminal && terminal_is_able() && environment("NO_COLOR").empty();
}

std::string Paint::marked(const char* code, const std::string& text) const {
  return on_ ? std::string("\x1b[") + code + "m" + text + "\x1b[0m" : text;
}

void wish_colors(ColorWish wish) { color_wish = wish; }

Paint paint_for(int file) { return Paint(colors_wanted(color_wish, is_terminal(file))); }

std::string pager_command() {
  const char* wished = std::getenv("PAGER");
  const std::string command = wished ? wished : "less";
  return command == "cat" ? "" : command;
}

void show(const std::string& text, bool paged) {
  const std::string command = paged && is_terminal(STDOUT_FILENO) ? pager_command() : "";
  std::fflush(stdout);
  if (command.empty() || !show_in_pager(command, text)) std::fputs(text.c_str(), stdout);
}

bool reader_has_gone() {
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  return poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

}  // namespace misalign::search
