#include "schema/kit/kit_notes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/kit/page_parts.hpp"

namespace misalign::schema {
namespace {

using Row = std::vector<std::string>;

std::string number_of(const KitSpring& spring) { return "s" + std::to_string(spring.from.spring); }

class Notes {
 public:
  Notes(const solver::Sheet& sheet, const Kit& kit, const KitOptions& options)
      : sheet_(sheet), kit_(kit), unit_(options.unit), rows_(kit_rows(sheet, options.from_deg)) {}

  std::string text() const { return cuts() + shifts() + springs() + lengths(); }

 private:
  std::string length(double length_mm) const { return length_number(length_mm, unit_, 3); }
  std::string headed(const std::string& heading, const std::string& tables) const {
    if (tables.empty()) return "";
    return "<h2>" + fmt::format(fmt::runtime(heading), name_of(unit_)) + "</h2>\n" + tables;
  }
  double row_deg(Eigen::Index row) const {
    return sheet_.history().stations[static_cast<std::size_t>(row)].pilot_deg;
  }

  std::string shifts() const {
    std::vector<Row> rows;
    for (Eigen::Index v = 0; v < sheet_.shifts_mm().cols(); ++v) {
      const Eigen::Vector2d shift_mm = sheet_.shifts_mm().col(v);
      if (shift_mm.isZero(0)) continue;
      const auto signed_length = [&](double length_mm) {
        return (length_mm < 0 ? "" : "+") + length_number(length_mm, unit_, 4);
      };
      rows.push_back({solver::vertex_label(static_cast<int>(v)), signed_length(shift_mm.x()),
                      signed_length(shift_mm.y())});
    }
    return headed("Shifts of vertices ({})", page_tables({"vertex", "dx", "dy"}, rows, 1));
  }

  std::string springs() const {
    std::vector<Row> rows;
    for (const KitSpring& spring : kit_.springs) {
      rows.push_back({number_of(spring), solver::line_label(spring.from.vertex, spring.to.vertex),
                      length(spring.diagonal_mm[0]), length(spring.length_mm[0]),
                      length(spring.length_mm.back()), length(spring.stroke_mm()),
                      word_of(spring.trend), word_of(spring.diagonal_trend)});
    }
    const std::string heading = fmt::format("Springs between flat and {:.10g}° ({{}})",
                                            rows_ == 0 ? 0 : row_deg(rows_ - 1));
    return headed(heading, page_tables({"no.", "ends", "diagonal, flat", "spring, flat",
                                        "spring, folded", "stroke", "spring", "diagonal"},
                                       rows, 2));
  }

  // The rows of a table: multiples of ten degrees, and the last that is used.
  std::vector<Eigen::Index> shown() const {
    constexpr double kStep_deg = 10;
    std::vector<Eigen::Index> rows = sheet_.rows_to_show(kStep_deg);
    std::erase_if(rows, [&](Eigen::Index row) { return row >= rows_; });
    if (rows_ > 0 && (rows.empty() || rows.back() != rows_ - 1)) rows.push_back(rows_ - 1);
    return rows;
  }

  std::string lengths() const {
    constexpr std::size_t kSprings = 6;  // in one table
    std::string text;
    for (std::size_t first = 0; first < kit_.springs.size(); first += kSprings) {
      const std::size_t end = std::min(first + kSprings, kit_.springs.size());
      Row heads = {"angle (°)"}, flat = {"0"};
      for (std::size_t s = first; s < end; ++s) {
        heads.push_back(number_of(kit_.springs[s]));
        flat.push_back(length(kit_.springs[s].length_mm[0]));
      }
      std::vector<Row> rows = {flat};
      for (const Eigen::Index row : shown()) {
        rows.push_back({fmt::format("{:.10g}", row_deg(row))});
        for (std::size_t s = first; s < end; ++s) {
          rows.back().push_back(
              length(kit_.springs[s].length_mm[static_cast<std::size_t>(row) + 1]));
        }
      }
      text += page_tables(heads, rows, 0);
    }
    return headed("Lengths of springs by pilot angle ({})", text);
  }

  std::string cuts() const {
    std::vector<Row> rows;
    for (const int c : kit_.cuts) {
      const solver::Crease& crease = sheet_.mechanism().creases[static_cast<std::size_t>(c)];
      rows.push_back({solver::line_label(crease.a, crease.b), panel_label(sheet_, crease.left),
                      panel_label(sheet_, crease.right)});
    }
    return headed("Creases cut for the bed, to be hinged",
                  page_tables({"crease", "panel", "panel"}, rows, 3));
  }

  const solver::Sheet& sheet_;
  const Kit& kit_;
  const LengthUnit unit_;
  const Eigen::Index rows_;
};

}  // namespace

std::string kit_tables(const solver::Sheet& sheet, const Kit& kit, const KitOptions& options) {
  return Notes(sheet, kit, options).text();
}

}  // namespace misalign::schema
