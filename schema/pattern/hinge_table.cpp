#include "schema/pattern/hinge_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/files/json_values.hpp"
#include "schema/files/suggestion.hpp"

namespace misalign::schema {
namespace {

constexpr std::optional<double> kNoValue = std::nullopt;
// Loss factors of films below the glass transition are 0.01 to 0.03; makers give none.
constexpr double kLoss = 0.02;

// A pin of this radius, mm, times its coefficient of friction.
constexpr double kPin_mm = 0.5;

constexpr HingeRow pin_row(std::string_view name, double coefficient, std::string_view source) {
  return {name, {}, kNoValue, coefficient * kPin_mm, kNoValue, CreaseCut::pin, source};
}

constexpr HingeRow film_row(std::string_view name, solver::FilmHinge strip,
                            std::string_view source) {
  return {name, strip, kNoValue, kNoValue, kNoValue, CreaseCut::film, source};
}

constexpr HingeRow kHinges[] = {
    film_row("polyimide film 0.05 mm", {0.05, 2.5, 1, kLoss},
             "DuPont, Kapton HN data sheet, table 1: yields at 3 %, beyond 69° at this length"),
    film_row(
        "polyester film 0.05 mm", {0.05, 4.9, 1, kLoss},
        "DuPont Teijin Films, Mylar, H-37232-3, table 1: yields at about 2 %, beyond 46° at this "
        "length"),
    film_row(
        "polyester film 0.1 mm", {0.1, 4.9, 2, kLoss},
        "DuPont Teijin Films, Mylar, H-37232-3, table 1: yields at about 2 %, beyond 46° at this "
        "length"),
    {"glued textile",
     {},
     kNoValue,
     kNoValue,
     kNoValue,
     CreaseCut::cut,
     "built sheets in the literature of folded structures: nearly no stiffness, no play, no dry "
     "friction"},
    {"printed pin hinge",
     {},
     kNoValue,
     kNoValue,
     0.2,
     CreaseCut::pin,
     "makers of printed hinges: diametral clearance mostly 0.3 to 0.5 mm"},
    pin_row("steel pin 1 mm in steel, dry", 0.7,
            "friction tables of mechanical engineering handbooks: 0.4 to 0.7"),
    pin_row("steel pin 1 mm in steel, greased", 0.1,
            "friction tables of mechanical engineering handbooks: 0.1"),
    pin_row("steel pin 1 mm in polyamide, dry", 0.45,
            "friction tables of mechanical engineering handbooks: 0.32 to 0.45"),
    pin_row("steel pin 1 mm in polyamide, greased", 0.1,
            "friction tables of mechanical engineering handbooks: 0.1"),
    pin_row("steel pin 1 mm in PTFE", 0.22,
            "friction tables of mechanical engineering handbooks: 0.04 to 0.22")};

std::string cell(const std::optional<double>& value) { return value ? shown_number(*value) : ""; }

std::string film_cell(const solver::FilmHinge& strip) {
  return fmt::format("{:g} mm, {:g} GPa, free {:g} mm, loss {:g}", strip.thickness_mm, strip.e_gpa,
                     strip.length_mm, strip.loss);
}

}  // namespace

std::span<const HingeRow> hinge_table() { return kHinges; }

const HingeRow* find_hinge(std::string_view name) {
  const auto* const row = std::ranges::find(kHinges, name, &HingeRow::name);
  return row == std::end(kHinges) ? nullptr : row;
}

std::vector<std::string> hinge_names() {
  std::vector<std::string> names;
  for (const HingeRow& row : kHinges) names.emplace_back(row.name);
  return names;
}

solver::OptionFault unknown_hinge(const std::string& typed) {
  return {"hinge", typed, "is no hinge of the table" + meant_names(typed, hinge_names()),
          "write a name that `misalign config --materials` lists"};
}

Json film_json(const solver::FilmHinge& strip) {
  return {{"thickness_mm", strip.thickness_mm},
          {"e_gpa", strip.e_gpa},
          {"length_mm", strip.length_mm},
          {"loss", strip.loss}};
}

Json hinge_table_json() {
  return json_list(kHinges, [](const HingeRow& row) -> Json {
    return {{"name", row.name},
            {"film", row.film ? film_json(*row.film) : Json()},
            {"stiffness_n_mm_per_mm", row.film ? Json(row.film->stiffness_n_mm_per_mm()) : Json()},
            {"friction_n_mm_per_mm", or_null(row.friction_n_mm_per_mm)},
            {"pin_friction_mm", or_null(row.pin_friction_mm)},
            {"play_mm", or_null(row.play_mm)},
            {"kind", crease_json(row.crease)},
            {"source", row.source}};
  });
}

std::string hinge_table_markdown() {
  std::string text =
      "| hinge | film | stiffness (N mm/mm/rad) | dry friction (N mm/mm) | pin friction (mm) | "
      "play "
      "(mm) | crease | source |\n|---|---|---|---|---|---|---|---|\n";
  for (const HingeRow& row : kHinges) {
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} | `{}` | {} |\n", row.name,
                        row.film ? film_cell(*row.film) : "",
                        row.film ? fmt::format("{:.2g}", row.film->stiffness_n_mm_per_mm()) : "",
                        cell(row.friction_n_mm_per_mm), cell(row.pin_friction_mm),
                        cell(row.play_mm), crease_json(row.crease).get<std::string>(), row.source);
  }
  return text;
}

}  // namespace misalign::schema
