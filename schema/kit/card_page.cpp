#include "schema/kit/card_page.hpp"

#include <fmt/format.h>

#include "schema/exchange/xml_text.hpp"
#include "schema/kit/page_parts.hpp"
#include "schema/kit/sheet_pictures.hpp"

namespace misalign::schema {
namespace {

std::string requirements(const Card& card) {
  std::string text = "<h2>Requirements</h2>\n<table>\n" +
                     table_row({"", "quantity", "required", "actual", "margin"}, 2, "th");
  for (const CardLine& line : card.lines) {
    if (!line.is_asked()) continue;
    const std::string row = table_row({line.passes() ? "pass" : "FAIL", line.what,
                                       line.wanted_text(), line.found_text(), line.margin_text()},
                                      2);
    text += line.passes() ? row : "<tr class=\"bad\">" + row.substr(std::string("<tr>").size());
  }
  return text + "</table>\n";
}

std::string remedies(const Card& card) {
  if (!card.remedies || card.remedies->empty()) return "";
  std::string text = "<h2>Remedies</h2>\n<table>\n";
  for (const CardLine& line : card.lines) {
    for (const std::string& words : card.remedy_texts(line.key)) {
      text += table_row({line.what, words}, 2);
    }
  }
  return text + "</table>\n";
}

std::string facts(const Card& card) {
  std::string text = "<h2>Further data</h2>\n<table>\n";
  for (const CardLine& line : card.lines) {
    if (line.is_asked() && line.note.empty()) continue;
    text += table_row({line.what, line.is_asked() ? "" : line.found_text(), line.note}, 3);
  }
  return text + "</table>\n";
}

}  // namespace

std::string card_page(const Card& card, const solver::Sheet& sheet,
                      const solver::Actuation& actuation) {
  std::string text =
      page_begin("Card of " + card.name, PageStyle::card) +
      fmt::format("<p class=\"{}\">Used between {:.10g}° and flat: {}.</p>\n",
                  card.passes() ? "" : "warning", card.from_deg, xml_text(card.verdict())) +
      requirements(card) + remedies(card) + facts(card) + "<div class=\"pair\">" +
      assembled_picture(sheet, card.design.diagonals_name());
  if (actuation.from_row > 0) {
    const auto row = static_cast<std::size_t>(actuation.from_row);
    text += folded_picture(sheet, sheet.shapes_mm()[row - 1], actuation.pilot_deg[row]);
  }
  return text + "</div>\n" +
         filling_table(sheet, actuation,
                       [&](int d) { return diagonal_lengths(sheet, actuation, d); }) +
         hinge_table(sheet, card.design.thickness_mm, actuation.from_row, card.from_deg) + kPageEnd;
}

}  // namespace misalign::schema
