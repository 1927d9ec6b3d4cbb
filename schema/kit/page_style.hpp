// Holds the style of printed pages, the card and the guide of a kit: colours, type, A4.
#pragma once

#include <string>

namespace misalign::schema {

/// Pages of A4, with letters of at least 2.5 mm; or a card, which fits one of them.
enum class PageStyle { guide, card };

/// CSS of a page: dark where the reader's screen is, light on paper.
std::string page_style(PageStyle style);

}  // namespace misalign::schema
