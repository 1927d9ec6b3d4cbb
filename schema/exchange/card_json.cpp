#include "schema/exchange/card_json.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/files/json_values.hpp"
#include "schema/pattern/design_json.hpp"

namespace misalign::schema {
namespace {

std::string with_unit(const std::string& number, const std::string& unit) {
  if (unit.empty()) return number;
  return unit == "deg" ? number + "°" : number + " " + unit;
}

}  // namespace

bool CardLine::passes() const {
  if (!wanted) return true;
  if (!found) return false;
  return bound == Bound::at_least ? *found >= *wanted : *found <= *wanted;
}

std::optional<double> CardLine::margin() const {
  if (!wanted || !found) return {};
  const auto [more, less] =
      bound == Bound::at_least ? std::pair(*found, *wanted) : std::pair(*wanted, *found);
  if (!(less > 0) || !(more > 0)) return {};
  return more / less - 1;
}

std::string CardLine::wanted_text() const {
  if (!wanted) return "";
  return (bound == Bound::at_least ? "≥ " : "≤ ") +
         with_unit(fmt::format("{:.10g}", *wanted), unit);
}

std::string CardLine::found_text() const {
  return found ? with_unit(fmt::format("{:.4g}", *found), unit) : "";
}

int Card::asked() const {
  return static_cast<int>(std::ranges::count_if(lines, &CardLine::is_asked));
}

int Card::passed() const {
  return static_cast<int>(std::ranges::count_if(
      lines, [](const CardLine& line) { return line.is_asked() && line.passes(); }));
}

std::string Card::verdict() const {
  return passes() ? fmt::format("all of {} requirements are met", asked())
                  : fmt::format("{} of {} requirements are met", passed(), asked());
}

Json card_json(const Card& card) {
  Json lines = Json::array();
  for (const CardLine& line : card.lines) {
    Json json = {{"key", line.key},
                 {"what", line.what},
                 {"unit", line.unit},
                 {"wanted", or_null(line.wanted)},
                 {"found", or_null(line.found)},
                 {"bound", line.bound == CardLine::Bound::at_least ? "at_least" : "at_most"},
                 {"margin", or_null(line.margin())},
                 {"passes", line.is_asked() ? Json(line.passes()) : Json()}};
    if (!line.note.empty()) json["note"] = line.note;
    lines.push_back(std::move(json));
  }
  return {{"passes", card.passes()},
          {"asked", card.asked()},
          {"passed", card.passed()},
          {"from_deg", card.from_deg},
          {"design", explicit_design_json(card.design)},
          {"lines", lines}};
}

}  // namespace misalign::schema
