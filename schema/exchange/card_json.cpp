#include "schema/exchange/card_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "schema/files/json_values.hpp"
#include "schema/pattern/design_json.hpp"

namespace misalign::schema {
namespace {

// Margins from which they are given as ratios.
constexpr double kMostPercent = 9;

// Ratio of two margins, and of two masses, from which a loss is a price; the number of prices.
constexpr double kNamedLoss = 0.95, kNamedMass = 1.02;
constexpr std::size_t kMostPrices = 2;

std::string with_unit(const std::string& number, const std::string& unit) {
  if (unit.empty()) return number;
  return unit == "deg" ? number + "°" : number + " " + unit;
}

// The ratio of a value to that of before: margins, and the inverse of masses.
double left_of(const CardLine& before, const CardLine& after) {
  if (before.margin() && after.margin()) return (1 + *after.margin()) / (1 + *before.margin());
  const bool is_heavier = after.key == "mass_g" && before.found && after.found &&
                          *after.found > kNamedMass * *before.found;
  return is_heavier ? kNamedLoss * *before.found / *after.found : 1;
}

Json remedy_json(const Remedy& remedy) {
  return {
      {"for", remedy.key},
      {"what", remedy.what},
      {"typed", remedy.typed},
      {"prices",
       json_list(
           remedy.prices,
           [](const Remedy::Price& price) {
             return Json{{"what", price.what}, {"before", price.before}, {"after", price.after}};
           })},
      {"meets_all", remedy.meets_all},
      {"pattern", remedy.pattern}};
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

std::string CardLine::margin_text() const {
  const std::optional<double> share = margin();
  if (!share) return "";
  return *share < kMostPercent ? fmt::format("{:+.3g} %", 100 * *share)
                               : fmt::format("{:.3g} times", *share + 1);
}

std::string CardLine::wanted_text() const {
  if (!wanted) return "";
  return (bound == Bound::at_least ? "≥ " : "≤ ") +
         with_unit(fmt::format("{:.10g}", *wanted), unit);
}

std::string CardLine::found_text() const {
  return found ? with_unit(fmt::format("{:.4g}", *found), unit) : "";
}

const CardLine* line_of(const std::vector<CardLine>& lines, std::string_view key) {
  const auto line =
      std::ranges::find_if(lines, [&](const CardLine& other) { return other.key == key; });
  return line == lines.end() ? nullptr : &*line;
}

int Card::asked() const {
  return static_cast<int>(std::ranges::count_if(lines, &CardLine::is_asked));
}

int Card::passed() const {
  return static_cast<int>(std::ranges::count_if(
      lines, [](const CardLine& line) { return line.is_asked() && line.passes(); }));
}

bool Card::passes_if_held() const {
  return !passes() && std::ranges::all_of(lines, [](const CardLine& line) {
    return !line.is_asked() || line.passes() || line.key == kUnstableAtFlat;
  });
}

std::string Card::verdict() const {
  if (!passes() && !passes_if_held()) {
    return fmt::format("fails {} of {} requirements", asked() - passed(), asked());
  }
  return fmt::format("meets all {} requirements", asked()) +
         (passes() ? "" : " if a stop, latch or frame holds it flat");
}

std::vector<Remedy> Card::remedies_of(std::string_view key) const {
  std::vector<Remedy> found = remedies.value_or(std::vector<Remedy>{});
  std::erase_if(found, [&](const Remedy& remedy) { return remedy.key != key; });
  return found;
}

std::string Remedy::effects() const {
  std::string text;
  for (const Price& price : prices) {
    text += fmt::format("; {}: {}, then {}", price.what, price.before, price.after);
  }
  return text + (meets_all ? "; then all requirements are met" : "");
}

std::vector<Remedy::Price> prices_of(const Card& before, const Card& after,
                                     std::string_view mended) {
  std::multimap<double, Remedy::Price> losses;
  for (const CardLine& line : after.lines) {
    const CardLine* const earlier = line_of(before.lines, line.key);
    if (earlier == nullptr || line.key == mended || earlier->found_text() == line.found_text()) {
      continue;
    }
    const double left = left_of(*earlier, line);
    if (left > kNamedLoss) continue;
    losses.emplace(left, Remedy::Price{line.what, earlier->found_text(), line.found_text()});
  }
  std::vector<Remedy::Price> prices;
  for (auto& [left, price] : losses) {
    if (prices.size() < kMostPrices) prices.push_back(std::move(price));
  }
  return prices;
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
  Json json = {{"passes", card.passes()},
               {"passes_if_held_flat", card.passes() || card.passes_if_held()},
               {"asked", card.asked()},
               {"passed", card.passed()},
               {"from_deg", card.from_deg},
               {"design", explicit_design_json(card.design)},
               {"lines", lines}};
  if (card.remedies) json["remedies"] = json_list(*card.remedies, remedy_json);
  return json;
}

}  // namespace misalign::schema
