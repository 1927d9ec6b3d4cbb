// Queries the terminal behind a file, and draws the live line on it.
#pragma once

#include <string>

namespace misalign::search {

bool is_terminal(int file);
/// Returns the columns of the terminal behind a file; 80 without one, or if it does not say.
int terminal_width(int file);
/// Returns whether TERM names a terminal that can return within a line, erase and color.
bool terminal_is_able();
/// Returns whether the locale's characters are UTF-8.
bool locale_is_utf8();

/// Replaces the live line on standard error; the text is at most as wide as the terminal.
void draw_live_line(const std::string& text);
/// Erases the live line before another message on standard error.
void erase_live_line();
/// Ends the live line with a line feed. Safe in a signal handler that ends the program.
void leave_live_line();

}  // namespace misalign::search
