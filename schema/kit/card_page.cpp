#include "schema/kit/card_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "schema/exchange/xml_text.hpp"
#include "schema/kit/margin_bar.hpp"
#include "schema/kit/page_parts.hpp"
#include "schema/kit/sheet_pictures.hpp"

namespace misalign::schema {
namespace {

// The name of a quantity, which ends at its first comma, and what it holds for.
std::string short_name(const CardLine& line) { return line.what.substr(0, line.what.find(',')); }
std::string quantity_of(const CardLine& line) {
  const std::string name = short_name(line);
  if (name == line.what) return xml_text(name);
  return fmt::format("{}<span class=\"quiet\">{}</span>", xml_text(name),
                     xml_text(line.what.substr(name.size())));
}

std::string verdict_banner(const Card& card) {
  std::vector<std::string> failed;
  for (const CardLine& line : card.lines) {
    if (!line.passes()) failed.push_back(short_name(line));
  }
  const bool held = card.passes_if_held();
  return page_banner(
      card.passes() ? BannerKind::passes
      : held        ? BannerKind::caution
                    : BannerKind::fails,
      card.passes() ? "Passes"
      : held        ? "Passes if held at flat"
                    : "Does not pass",
      fmt::format("Used between {:.10g}° and flat: {}{}.", card.from_deg, card.verdict(),
                  failed.empty() || held ? "" : fmt::format(": {}", fmt::join(failed, "; "))));
}

std::string requirements(const Card& card) {
  std::string text = "<h2>Requirements</h2>\n" +
                     table_begin({"result", "quantity", "required", "actual", "margin", "left"}, 2,
                                 "requirements");
  const auto number = [](const char* head, const std::string& words) {
    return words.empty()
               ? "<td></td>"
               : fmt::format("<td class=\"n\" data-head=\"{}\">{}</td>", head, xml_text(words));
  };
  for (const CardLine& line : card.lines) {
    if (!line.is_asked()) continue;
    text += fmt::format(
        "<tr class=\"{}\"><td>{}</td><td>{}</td>{}{}{}<td class=\"left\">{}{}</td></tr>\n",
        line.passes() ? "pass" : "fail", line.passes() ? "pass" : "FAIL", quantity_of(line),
        number("required", line.wanted_text()), number("actual", line.found_text()),
        number("margin", line.margin_text()), margin_bar(line), xml_text(left_text(line)));
  }
  return text + kTableEnd +
         "<p class=\"quiet\">A bar runs from zero to the actual value; the line is the required "
         "one, and values on its green side meet it.</p>\n";
}

std::string remedies(const Card& card) {
  if (!card.remedies) return "";
  std::string text = "<h2>Remedies</h2>\n";
  for (const CardLine& line : card.lines) {
    if (line.passes()) continue;
    std::string items;
    for (const Remedy& remedy : card.remedies_of(line.key)) {
      items +=
          fmt::format("<li>{}: <code>{}</code><span class=\"quiet\">{}</span></li>\n",
                      xml_text(remedy.what), xml_text(remedy.typed), xml_text(remedy.effects()));
    }
    text += fmt::format("<p>{}: {}</p>\n", quantity_of(line),
                        items.empty() ? "no single change that was tried meets this requirement."
                                      : "met with one of these changes");
    if (!items.empty()) text += "<ul>\n" + items + "</ul>\n";
  }
  return text;
}

std::string facts(const Card& card) {
  std::string text =
      "<h2>Further data</h2>\n" + table_begin({"quantity", "value", "note"}, 3, "facts");
  for (const CardLine& line : card.lines) {
    if (line.is_asked() && line.note.empty()) continue;
    text += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", quantity_of(line),
                        line.is_asked() ? "" : xml_text(line.found_text()), xml_text(line.note));
  }
  return text + kTableEnd;
}

}  // namespace

std::string card_page(const Card& card, const solver::Sheet& sheet,
                      const solver::Actuation& actuation) {
  std::string text = page_begin("Card of " + card.name, PageStyle::card) + verdict_banner(card) +
                     requirements(card) + remedies(card) + facts(card) +
                     "<h2>Drawings</h2>\n<div class=\"pair\">" +
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
