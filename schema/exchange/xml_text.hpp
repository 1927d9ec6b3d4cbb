// Escapes text for XML and HTML: SVG, MJCF, the card and the guide of a kit.
#pragma once

#include <string>

#include "schema/files/printable.hpp"

namespace misalign::schema {

/// Text as content or an attribute, without control characters, most of which XML cannot express.
inline std::string xml_text(const std::string& text) {
  std::string xml;
  for (const char c : printable(text)) {
    switch (c) {
      case '&':
        xml += "&amp;";
        break;
      case '<':
        xml += "&lt;";
        break;
      case '>':
        xml += "&gt;";
        break;
      case '"':
        xml += "&quot;";
        break;
      default:
        xml += c;
    }
  }
  return xml;
}

}  // namespace misalign::schema
