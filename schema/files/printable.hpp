// Makes text of unknown origin safe to show, with one escape for control characters.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace misalign::schema {

/// Returns a text on one line in which nothing can end a sentence, move a cursor, colour, erase, or
/// change the reading order: control characters (C0, DEL, C1), separators of lines, bidi controls
/// and invisible tags become \u001b, invalid UTF-8 \xff. All other text is unchanged, so that a
/// second call changes nothing.
std::string printable(std::string_view text);

/// Does the same to text of several lines: line feeds stay.
std::string printable_lines(std::string_view text);

/// Does the same to JSON, where only strings can hold such characters: \u001b is JSON's own escape,
/// so that a reader gets the original. UTF-8 is expected. Line feeds stay.
std::string printable_json(std::string_view json);

/// Does the same to rows of CSV: a line feed ends a row, unless it is within quotes.
std::string printable_csv(std::string_view rows);

/// Returns head and tail of a text with "..." between them, at most `most` bytes (at least 20), cut
/// between characters.
std::string shortened(const std::string& text, std::size_t most);

/// Returns a text of unknown origin as valid UTF-8, which JSON requires, with U+FFFD for invalid
/// bytes.
std::string utf8(const std::string& text);

}  // namespace misalign::schema
