// Text of unknown origin, made safe to show: the one escape for control characters.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace misalign::schema {

/// A text on one line in which nothing can end a sentence, move a cursor, colour, erase, or turn
/// the reading order: control characters (C0, DEL, C1), separators of lines, bidi controls and
/// invisible tags as \u001b, bytes that are no UTF-8 as \xff. Everything else stays as it is, so
/// that the result put in again comes out the same.
std::string printable(std::string_view text);

/// The same for text of several lines: line feeds stay.
std::string printable_lines(std::string_view text);

/// The same for JSON, whose strings alone can hold such characters: \u001b is JSON's own form of
/// them, so that what reads it gets what was there. UTF-8 is expected. Line feeds stay.
std::string printable_json(std::string_view json);

/// The same for rows of CSV: a line feed ends a row, unless it is within quotes.
std::string printable_csv(std::string_view rows);

/// Head and tail of a text with "..." between them, `most` bytes (at least 20) at most; cut between
/// characters.
std::string shortened(const std::string& text, std::size_t most);

/// A text of unknown origin, with U+FFFD for what is no UTF-8 in it: JSON has no other.
std::string utf8(const std::string& text);

}  // namespace misalign::schema
