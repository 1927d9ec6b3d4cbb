// The screen behind a file: whether there is one, what it can, and the live line on it.
#pragma once

#include <string>

namespace misalign::search {

bool is_terminal(int file);
/// Columns of the terminal behind a file; 80 where there is none, or where it does not say.
int terminal_width(int file);
/// True where TERM names a terminal that can go back within a line, erase and color.
bool terminal_is_able();
/// True where the locale's characters are UTF-8.
bool locale_is_utf8();

/// One line on standard error, in the place of the last one; no wider than the terminal.
void draw_live_line(const std::string& text);
/// Makes room for another message on standard error; the next show() draws the live line again.
void erase_live_line();
/// Safe in a signal handler that ends the program: what others print begins a line.
void leave_live_line();

}  // namespace misalign::search
