// Draws what is left of a requirement as a bar: its value, its limit, and the side that meets it.
#pragma once

#include <string>

#include "schema/exchange/card_json.hpp"

namespace misalign::schema {

/// "93° left", "0.61 short" or "2 N over"; "no result" where there is none, and
/// nothing of an infinite one.
std::string left_text(const CardLine& line);

/// An inline SVG from zero to the value, with a line at the limit; empty without a finite result.
/// Its label has both numbers and what is left.
std::string margin_bar(const CardLine& line);

}  // namespace misalign::schema
