#include "schema/kit/kit_notes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/files/printable.hpp"
#include "schema/kit/panel_room.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kNote_mm = 2.5, kNoteLine_mm = 4.5;  // capitals' height; line spacing

using Row = std::vector<std::string>;

// Wraps words to lines of a number of letters; a longer word is a line of its own.
std::vector<std::string> wrapped(const std::string& sentence, std::size_t letters) {
  std::vector<std::string> lines(1);
  for (std::size_t at = 0; at < sentence.size();) {
    const std::size_t end = std::min(sentence.find(' ', at), sentence.size());
    const std::string word = sentence.substr(at, end - at);
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > letters) {
      lines.emplace_back();
    }
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    at = end + 1;
  }
  return lines;
}

DrawnText written(double x, double y, const std::string& words) {
  return {{x, y}, words, kNote_mm, false, 0};
}

// A table with a line of headings; its columns are as wide as their widest words.
KitItem table(const std::string& caption, const Row& heads, const std::vector<Row>& rows) {
  constexpr double kBetween_mm = 3;
  std::vector<double> starts(1, 0.0);
  for (std::size_t c = 0; c < heads.size(); ++c) {
    double width = text_width(heads[c]);
    for (const Row& row : rows) width = std::max(width, text_width(row[c]));
    starts.push_back(starts.back() + width * kNote_mm + kBetween_mm);
  }
  const double width = std::max(starts.back() - kBetween_mm, text_width(caption) * kNote_mm);
  const double height = static_cast<double>(rows.size() + 2) * kNoteLine_mm;
  KitItem item = empty_item({0, 0}, {width, height});
  LineLayer& note = item.on(KitLayer::note);
  double y = height - kNote_mm;
  note.texts.push_back(written(0, y, caption));
  const auto add = [&](const Row& row) {
    y -= kNoteLine_mm;
    for (std::size_t c = 0; c < row.size(); ++c) {
      note.texts.push_back(written(starts[c], y, row[c]));
    }
  };
  add(heads);
  const double under = y - 0.4 * (kNoteLine_mm - kNote_mm);
  note.paths.push_back({{{0, under}, {width, under}}, false});
  for (const Row& row : rows) add(row);
  return item;
}

void add_blocks(const std::string& caption, const Row& heads, const std::vector<Row>& rows,
                double most_height_mm, std::vector<KitItem>& items) {
  constexpr double kMostRows = 25;
  const auto most =
      static_cast<std::size_t>(std::clamp(most_height_mm / kNoteLine_mm - 2, 1.0, kMostRows));
  for (std::size_t first = 0; first < rows.size(); first += most) {
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = static_cast<std::ptrdiff_t>(std::min(most, rows.size() - first));
    items.push_back(table(first == 0 ? caption : caption + ", continued", heads,
                          std::vector<Row>(begin, begin + count)));
  }
}

std::vector<Row> shift_rows(const solver::Sheet& sheet) {
  std::vector<Row> rows;
  for (Eigen::Index v = 0; v < sheet.shifts_mm().cols(); ++v) {
    if (sheet.shifts_mm().col(v).isZero(0)) continue;
    rows.push_back({solver::vertex_label(static_cast<int>(v)),
                    fmt::format("{:+.4f}", sheet.shifts_mm()(0, v)),
                    fmt::format("{:+.4f}", sheet.shifts_mm()(1, v))});
  }
  return rows;
}

std::string number_of(const KitSpring& spring) { return "s" + std::to_string(spring.from.spring); }

std::vector<Row> spring_rows(const std::vector<KitSpring>& springs) {
  std::vector<Row> rows;
  for (const KitSpring& spring : springs) {
    rows.push_back({number_of(spring), solver::line_label(spring.from.vertex, spring.to.vertex),
                    fmt::format("{:.3f}", spring.diagonal_mm[0]),
                    fmt::format("{:.3f}", spring.length_mm[0])});
  }
  return rows;
}

std::vector<Row> spring_stroke_rows(const std::vector<KitSpring>& springs) {
  std::vector<Row> rows;
  for (const KitSpring& spring : springs) {
    rows.push_back({number_of(spring), fmt::format("{:.3f}", spring.length_mm.back()),
                    fmt::format("{:.3f}", spring.stroke_mm()), word_of(spring.trend),
                    word_of(spring.diagonal_trend)});
  }
  return rows;
}

// Tables of a few springs' lengths: flat, every ten degrees, and at the end.
void add_histories(const solver::Sheet& sheet, const std::vector<KitSpring>& springs,
                   double most_height_mm, std::vector<KitItem>& items) {
  constexpr std::size_t kSprings = 4;
  constexpr double kStep_deg = 10;
  const auto shown = sheet.rows_to_show(kStep_deg);
  for (std::size_t first = 0; first < springs.size(); first += kSprings) {
    const std::size_t end = std::min(first + kSprings, springs.size());
    Row heads = {"deg"}, flat = {"0"};
    for (std::size_t s = first; s < end; ++s) {
      heads.push_back(number_of(springs[s]));
      flat.push_back(fmt::format("{:.3f}", springs[s].length_mm[0]));
    }
    std::vector<Row> rows = {flat};
    for (const Eigen::Index row : shown) {
      const auto at = static_cast<std::size_t>(row);
      rows.push_back({fmt::format("{:.10g}", sheet.history().stations[at].pilot_deg)});
      for (std::size_t s = first; s < end; ++s) {
        rows.back().push_back(fmt::format("{:.3f}", springs[s].length_mm[at + 1]));
      }
    }
    add_blocks("spring lengths (mm) by pilot angle", heads, rows, most_height_mm, items);
  }
}

}  // namespace

KitItem kit_heading(const std::vector<std::string>& sentences, double width_mm) {
  constexpr double kGauge_mm = 100, kTick_mm = 4;
  const auto letters = static_cast<std::size_t>(width_mm / (kNote_mm * text_width("x")));
  std::vector<std::string> lines;
  for (const std::string& sentence : sentences) {
    for (std::string& line : wrapped(printable(utf8(sentence)), letters)) {
      lines.push_back(shortened(line, std::max<std::size_t>(letters, 20)));
    }
  }
  const double height = static_cast<double>(lines.size()) * kNoteLine_mm + kTick_mm;
  KitItem item = empty_item({0, 0}, {width_mm, height});
  LineLayer& note = item.on(KitLayer::note);
  double y = height - kNote_mm;
  for (const std::string& line : lines) {
    note.texts.push_back(written(0, y, line));
    y -= kNoteLine_mm;
  }
  const double middle = 0.5 * kTick_mm;
  note.paths.push_back({{{0, middle}, {kGauge_mm, middle}}, false});
  for (const double x : {0.0, kGauge_mm}) {
    note.paths.push_back({{{x, 0}, {x, kTick_mm}}, false});
  }
  note.texts.push_back(written(kGauge_mm + kNote_mm, middle - 0.5 * kNote_mm, "100 mm"));
  return item;
}

std::vector<KitItem> kit_tables(const solver::Sheet& sheet, const std::vector<KitSpring>& springs,
                                const std::vector<int>& cuts, double most_height_mm) {
  std::vector<KitItem> items;
  add_blocks("shifts (mm)", {"vertex", "dx", "dy"}, shift_rows(sheet), most_height_mm, items);
  add_blocks("springs when flat (mm)", {"no.", "ends", "vertices", "spring"}, spring_rows(springs),
             most_height_mm, items);
  const Eigen::Index rows = sheet.rows_shown();
  const double end_deg =
      rows == 0 ? 0 : sheet.history().stations[static_cast<std::size_t>(rows - 1)].pilot_deg;
  add_blocks(fmt::format("springs from flat to {:.10g} deg (mm)", end_deg),
             {"no.", "at the end", "stroke", "spring", "diagonal"}, spring_stroke_rows(springs),
             most_height_mm, items);
  add_histories(sheet, springs, most_height_mm, items);
  std::vector<Row> hinges;
  for (const int c : cuts) {
    const solver::Crease& crease = sheet.mechanism().creases[static_cast<std::size_t>(c)];
    hinges.push_back({solver::line_label(crease.a, crease.b), panel_label(sheet, crease.left),
                      panel_label(sheet, crease.right)});
  }
  add_blocks("creases cut, to be hinged", {"crease", "panel", "panel"}, hinges, most_height_mm,
             items);
  return items;
}

}  // namespace misalign::schema
