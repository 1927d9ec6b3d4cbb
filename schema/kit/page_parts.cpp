#include "schema/kit/page_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/exchange/xml_text.hpp"
#include "schema/kit/kit_hinges.hpp"
#include "schema/pattern/fill_words.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::schema {
namespace {

// One row for each spring; a diagonal without one has none.
std::string spring_table(const solver::Sheet& sheet, const solver::Actuation& actuation,
                         const std::function<SpringLengths(int)>& lengths, LengthUnit unit) {
  const solver::Mechanism& mechanism = sheet.mechanism();
  const solver::Fill& fill = actuation.actuators.fill;
  const solver::Filling filling = solver::filling_of(sheet, fill);
  std::vector<int> few;
  if (actuation.few) few = actuation.few->diagonals;
  std::string text = fmt::format(
      "<h2>Springs</h2>\n<p>{} {}. Folded: pilot angle {:.10g}°. A spring pulls where it is longer "
      "than its free length{}.</p>\n",
      std::get<solver::Springs>(fill).pull_only ? "All wires are" : "All springs are",
      rest_words(fill, kDegreeSign),
      actuation.pilot_deg[static_cast<std::size_t>(actuation.from_row)],
      std::get<solver::Springs>(fill).pull_only ? "" : ", and pushes where it is shorter");
  const std::string bracket = fmt::format(" ({})", name_of(unit));
  text += table_begin({"no.", "vertices", "force", "enough", "free" + bracket, "flat" + bracket,
                       "folded" + bracket, "elongation (%)", "force (N)"},
                      4, "numbers");
  double largest_n = 0;
  Eigen::Index count = 0;
  for (int d = 0; d < mechanism.diagonal_count(); ++d) {
    const double rate_n_per_mm = filling.rates_n_per_mm()(d);
    if (rate_n_per_mm == 0) continue;
    ++count;
    const auto [flat_mm, folded_mm] = lengths(d);
    const auto at = static_cast<std::size_t>(d);
    const double free_mm = flat_mm + actuation.free_mm[at] - sheet.history().flat_mm[at];
    const bool is_slack = std::get<solver::Springs>(fill).pull_only && folded_mm < free_mm;
    const double force_n = is_slack ? 0 : rate_n_per_mm * std::abs(folded_mm - free_mm);
    largest_n = std::max(largest_n, force_n);
    const solver::Diagonal& diagonal = mechanism.diagonals[at];
    text += table_row(
        {"s" + std::to_string(d), solver::line_label(diagonal.from, diagonal.to),
         is_slack               ? "slack"
         : folded_mm >= free_mm ? "pulls"
                                : "pushes",
         std::ranges::count(few, d) > 0 ? "yes" : "", length_number(free_mm, unit, 2),
         length_number(flat_mm, unit, 2), length_number(folded_mm, unit, 2),
         fmt::format("{:+.2f}", 100 * (folded_mm / flat_mm - 1)), fmt::format("{:.3g}", force_n)},
        4);
  }
  text += fmt::format("{}<p>Largest force: {:.3g} N.", kTableEnd, largest_n);
  if (!few.empty()) {
    text += fmt::format(
        " The {} of {} springs marked “enough” alone keep {:.0f} % of the least moment.",
        few.size(), count, 100 * actuation.few->share);
  }
  return text + "</p>\n";
}

// One row for each hole: its plate's cut-out, and its diagonals flat and folded.
std::string plate_table(const solver::Sheet& sheet, const solver::Actuation& actuation,
                        LengthUnit unit) {
  const solver::Fill& fill = actuation.actuators.fill;
  const solver::Filling filling = solver::filling_of(sheet, fill);
  const std::vector<solver::Diagonal>& diagonals = sheet.mechanism().diagonals;
  std::string text = fmt::format(
      "<h2>Rubber plates</h2>\n<p>{}, bonded to the edges of their holes. Cut-out: the diagonals "
      "of a plate without stress. Folded: pilot angle {:.10g}°.</p>\n",
      filling_words(fill, sheet.mechanism().diagonal_count(), kDegreeSign),
      actuation.pilot_deg[static_cast<std::size_t>(actuation.from_row)]);
  const std::string bracket = fmt::format(" ({})", name_of(unit));
  text += table_begin({"hole", "diagonals", "cut-out" + bracket, "flat" + bracket,
                       "folded" + bracket, "energy (N mm)"},
                      2, "numbers");
  for (Eigen::Index h = 0; h < filling.holes(); ++h) {
    const auto first = static_cast<std::size_t>(2 * h);
    const auto pair = [&](const auto& text_of, const char* between) {
      return text_of(first) + between + text_of(first + 1);
    };
    const auto length = [&](double SpringLengths::*state) {
      return pair(
          [&](std::size_t d) {
            return length_number(diagonal_lengths(sheet, actuation, static_cast<int>(d)).*state,
                                 unit, 2);
          },
          " × ");
    };
    Eigen::Vector2d folded_mm;
    for (int k = 0; k < 2; ++k) {
      folded_mm(k) = diagonal_lengths(sheet, actuation, static_cast<int>(2 * h) + k).folded_mm;
    }
    const int facet = sheet.base().holes[static_cast<std::size_t>(h)];
    const auto& place = sheet.base().sheet.places[static_cast<std::size_t>(facet)];
    text += table_row(
        {fmt::format("row {}, column {}", place[0], place[1]),
         pair([&](std::size_t d) { return solver::line_label(diagonals[d].from, diagonals[d].to); },
              " × "),
         pair([&](std::size_t d) { return length_number(actuation.free_mm[d], unit, 2); }, " × "),
         length(&SpringLengths::flat_mm), length(&SpringLengths::folded_mm),
         fmt::format("{:.3g}", filling.hole(h, folded_mm).n_mm)},
        2);
  }
  return text + kTableEnd;
}

}  // namespace

std::string page_begin(const std::string& title, PageStyle style) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>{0}</title>\n<style>{1}</style></head><body><main>\n<h1>{0}</h1>\n",
      xml_text(title), page_style(style));
}

std::string page_banner(BannerKind kind, const std::string& heading, const std::string& paragraph) {
  const char* const name = kind == BannerKind::passes  ? "passes"
                           : kind == BannerKind::fails ? "fails"
                                                       : "caution";
  return fmt::format("<div class=\"verdict {}\"><strong>{}</strong><p>{}</p></div>\n", name,
                     xml_text(heading), xml_text(paragraph));
}

std::string table_row(const std::vector<std::string>& cells, std::size_t numbers,
                      const char* cell) {
  std::string text = "<tr>";
  for (std::size_t c = 0; c < cells.size(); ++c) {
    text += fmt::format("<{0}{1}>{2}</{0}>", cell, c >= numbers ? " class=\"n\"" : "",
                        xml_text(cells[c]));
  }
  return text + "</tr>\n";
}

std::string table_begin(const std::vector<std::string>& heads, std::size_t numbers,
                        const char* name) {
  return fmt::format("<table{}><thead>\n{}</thead><tbody>\n",
                     *name == '\0' ? "" : fmt::format(" class=\"{}\"", name),
                     table_row(heads, numbers, "th"));
}

std::string page_tables(const std::vector<std::string>& heads,
                        const std::vector<std::vector<std::string>>& rows, std::size_t numbers) {
  constexpr std::size_t kMostRows = 24;
  const std::size_t tables = (rows.size() + kMostRows - 1) / kMostRows;
  std::string text;
  for (std::size_t t = 0; t < tables; ++t) {
    text += table_begin(heads, numbers, "beside");
    for (std::size_t r = t * rows.size() / tables; r < (t + 1) * rows.size() / tables; ++r) {
      text += table_row(rows[r], numbers);
    }
    text += kTableEnd;
  }
  return text;
}

std::string hinge_table(const solver::Sheet& sheet, std::optional<double> thickness_mm,
                        Eigen::Index from_row, double from_deg, LengthUnit unit) {
  std::string text =
      "<h2>Hinges</h2>\n" +
      table_begin({"hinges", "largest fold angle",
                   thickness_mm ? fmt::format("gap, film at half thickness, panels of {}",
                                              length_text(*thickness_mm, unit, 2))
                                : "gap, film at half thickness, per mm",
                   "or bevel of edges"},
                  1);
  for (const bool valley : {false, true}) {
    const KitHinges hinges(sheet, valley, from_row);
    text += table_row({hinges.name, fmt::format("{:.1f}°", hinges.fold_deg),
                       thickness_mm ? length_text(hinges.gap_mm(*thickness_mm), unit, 2)
                                    : fmt::format("{:.2f} mm", hinges.gap_mm(1)),
                       fmt::format("{:.1f}°", hinges.bevel_deg())},
                      1);
  }
  text +=
      fmt::format("{}<p>Values up to {:.10g}°. Hinges lie in the mid-plane, at half the thickness.",
                  kTableEnd, from_deg);
  const FaceHingeMisfit misfit = face_hinge_misfit(sheet, from_row);
  if (misfit.loop) {
    text += fmt::format(
        " Hinges on the faces on which creases close would leave a gap of {1:.2f} mm{2} round {0}.",
        misfit.place(sheet), misfit.per_mm * thickness_mm.value_or(1),
        thickness_mm ? fmt::format(" at {:g} mm thickness", *thickness_mm)
                     : std::string(" per mm of thickness"));
  }
  return text + "</p>\n";
}

SpringLengths diagonal_lengths(const solver::Sheet& sheet, const solver::Actuation& actuation,
                               int diagonal) {
  const double flat_mm = sheet.history().flat_mm[static_cast<std::size_t>(diagonal)];
  const Eigen::Index at = actuation.from_row;
  return {flat_mm, at == 0 ? flat_mm : sheet.history().length_mm(at - 1, diagonal)};
}

std::string filling_table(const solver::Sheet& sheet, const solver::Actuation& actuation,
                          const std::function<SpringLengths(int)>& lengths, LengthUnit unit) {
  const solver::Fill& fill = actuation.actuators.fill;
  if (std::holds_alternative<solver::Springs>(fill)) {
    return spring_table(sheet, actuation, lengths, unit);
  }
  return std::holds_alternative<solver::RubberPlates>(fill) ? plate_table(sheet, actuation, unit)
                                                            : "";
}

}  // namespace misalign::schema
