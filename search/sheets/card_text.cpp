#include "search/sheets/card_text.hpp"

#include <fmt/format.h>

#include "schema/files/text_table.hpp"

namespace misalign::search {

std::string card_text(const schema::Card& card) {
  std::vector<schema::Row> asked = {{"", "requirement", "required", "found", "margin"}}, facts;
  for (const schema::CardLine& line : card.lines) {
    if (line.is_asked()) {
      asked.push_back({line.passes() ? "pass" : "FAIL", line.what, line.wanted_text(),
                       line.found_text(), line.margin_text()});
      if (!line.note.empty()) facts.push_back({line.what, line.note});
    } else {
      const std::string found = line.found_text();
      facts.push_back(
          {line.what, found + (found.empty() || line.note.empty() ? "" : "; ") + line.note});
    }
  }
  std::string remedies;
  for (const schema::CardLine& line : card.lines) {
    if (line.passes() || !card.remedies) continue;
    const std::vector<schema::Remedy> changes = card.remedies_of(line.key);
    remedies +=
        fmt::format("\n{}: {}\n", line.what,
                    changes.empty() ? "no single change that was tried meets this requirement"
                                    : "met with one of these changes");
    for (const schema::Remedy& change : changes) {
      remedies += fmt::format("  {} ({}){}\n", change.what, change.typed, change.effects());
    }
  }
  return fmt::format("{}, used between {:.10g}° and flat: {}\n\n{}{}\n{}", card.name, card.from_deg,
                     card.verdict(), schema::aligned(asked, {false, false, true, true, true}),
                     remedies, schema::aligned(facts, {false, false}));
}

std::string cards_text(const schema::Card& before, const schema::Card& after) {
  const auto shown = [](const schema::CardLine& line) {
    const std::string found = line.found_text();
    return found.empty() ? line.note : found;
  };
  std::vector<schema::Row> rows = {{"", "requirement", "required", "before", "after"}};
  for (const schema::CardLine& line : after.lines) {
    const schema::CardLine* const earlier = schema::line_of(before.lines, line.key);
    const std::string was = earlier == nullptr ? "" : shown(*earlier);
    const char* const passes = !line.is_asked() ? "" : line.passes() ? "pass" : "FAIL";
    rows.push_back({passes, line.what, line.wanted_text(), was, shown(line)});
  }
  return fmt::format("{}\nbefore: {}\nafter: {}\n",
                     schema::aligned(rows, {false, false, true, true, true}), before.verdict(),
                     after.verdict());
}

}  // namespace misalign::search
