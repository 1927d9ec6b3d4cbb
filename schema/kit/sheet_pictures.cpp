#include "schema/kit/sheet_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "schema/exchange/svg_picture.hpp"
#include "schema/kit/panel_corner.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::vector<Vector2d> corners_mm(const solver::Sheet& sheet, std::size_t panel) {
  std::vector<Vector2d> at;
  for (const int v : sheet.panels().corners[panel]) at.push_back(sheet.point_mm(v));
  return at;
}

Vector2d middle(const std::vector<Vector2d>& corners) {
  return std::accumulate(corners.begin(), corners.end(), Vector2d(0, 0)) / 4.0;
}

// A light colour, another one for each of twelve rows.
std::string row_colour(int row) {
  constexpr int kHues = 12, kStep_deg = 150;
  return fmt::format("hsl({},75%,78%)", row % kHues * kStep_deg % 360);
}

}  // namespace

std::string row_picture(const solver::Sheet& sheet, int row, const std::string& caption) {
  SvgPicture picture;
  const auto& places = sheet.base().sheet.places;
  for (std::size_t p = 0; p < sheet.panels().facets.size(); ++p) {
    const int of_panel = places[static_cast<std::size_t>(sheet.panels().facets[p])][0];
    picture.polygon(corners_mm(sheet, p), fmt::format("fill:{};stroke:#333;stroke-width:.6",
                                                      of_panel == row  ? row_colour(row)
                                                      : of_panel < row ? "#ddd"
                                                                       : "#fff"));
  }
  for (std::size_t p = 0; p < sheet.panels().facets.size(); ++p) {
    const int facet = sheet.panels().facets[p];
    if (places[static_cast<std::size_t>(facet)][0] != row) continue;
    picture.label(middle(corners_mm(sheet, p)), panel_label(sheet, facet));
  }
  return picture.figure(caption, FigureSize::half);
}

std::string bed_picture(const solver::Sheet& sheet, const Kit& kit, std::size_t bed) {
  SvgPicture picture;
  const Vector2d& size = kit.sheets.size_mm;
  picture.polygon({{0, 0}, {size.x(), 0}, size, {0, size.y()}}, "fill:none;stroke:#333");
  std::vector<std::pair<Vector2d, std::string>> labels;
  for (std::size_t k = 0; k < kit.parts.size(); ++k) {
    const Nested& place = kit.sheets.places[k];
    if (place.bed != bed) continue;
    for (const int facet : kit.parts[k].facets) {
      std::vector<Vector2d> corners;
      for (const int v : sheet.base().sheet.facets[static_cast<std::size_t>(facet)]) {
        corners.push_back(place(sheet.point_mm(v)));
      }
      const int row = sheet.base().sheet.places[static_cast<std::size_t>(facet)][0];
      picture.polygon(corners, fmt::format("fill:{};stroke:#333;stroke-width:.6", row_colour(row)));
      labels.emplace_back(middle(corners), panel_label(sheet, facet));
    }
  }
  for (const auto& [at_mm, words] : labels) picture.label(at_mm, words);
  for (const Vector2d& mark : kit.sheets.marks_mm) picture.dot(mark, 0.5 * kMark_mm);
  constexpr std::size_t kFew = 2;
  return picture.figure(fmt::format("Sheet {} of {}", bed + 1, kit.sheets.beds.size()),
                        kit.sheets.beds.size() <= kFew ? FigureSize::wide : FigureSize::half);
}

std::string assembled_picture(const solver::Sheet& sheet, const std::string& diagonals) {
  const solver::Mechanism& mechanism = sheet.mechanism();
  SvgPicture picture;
  for (std::size_t p = 0; p < sheet.panels().facets.size(); ++p) {
    picture.polygon(corners_mm(sheet, p), "fill:#eef;stroke:none");
  }
  for (const solver::Crease& crease : mechanism.creases) {
    picture.line(sheet.point_mm(crease.a), sheet.point_mm(crease.b),
                 mechanism.is_valley(crease) ? "stroke:#06c;stroke-dasharray:4 3" : "stroke:#c00");
  }
  for (int d = 0; d < mechanism.diagonal_count(); ++d) {
    const solver::Diagonal& diagonal = mechanism.diagonals[static_cast<std::size_t>(d)];
    const Vector2d from = sheet.point_mm(diagonal.from), to = sheet.point_mm(diagonal.to);
    picture.line(from, to, "stroke:#393");
    picture.label(from + 0.38 * (to - from), "s" + std::to_string(d));
  }
  for (const solver::BallJoint& ball : mechanism.balls) {
    picture.dot(sheet.point_mm(ball.vertex), 0.05 * mechanism.panel_width_mm);
    picture.label(sheet.point_mm(ball.vertex) + Vector2d(0, 0.14 * mechanism.panel_width_mm),
                  solver::vertex_label(ball.vertex));
  }
  return picture.figure(
      "Mountains: red; valleys: blue, dashed; " + diagonals + ": green; ball joints: dots",
      FigureSize::wide);
}

// Draws the farthest panels first.
std::string folded_picture(const solver::Sheet& sheet, const Eigen::Matrix3Xd& shape_mm,
                           double pilot_deg) {
  struct Seen {
    double near;
    std::vector<Vector2d> corners;
    bool from_above;
  };
  std::vector<Seen> panels;
  for (const auto& corners : sheet.panels().corners) {
    Seen panel{0, {}, true};
    for (const int v : corners) {
      const Vector3d at = seen_from_aside(shape_mm.col(v));
      panel.corners.push_back(at.head<2>());
      panel.near += at.z();
    }
    const Vector2d first = panel.corners[2] - panel.corners[0],
                   second = panel.corners[3] - panel.corners[1];
    panel.from_above = first.x() * second.y() - first.y() * second.x() > 0;
    panels.push_back(std::move(panel));
  }
  std::ranges::stable_sort(panels, {}, &Seen::near);
  SvgPicture picture;
  for (const Seen& panel : panels) {
    picture.polygon(panel.corners, panel.from_above ? "fill:#dde;stroke:#333;stroke-width:.6"
                                                    : "fill:#fe9;stroke:#333;stroke-width:.6");
  }
  return picture.figure(fmt::format("Pilot angle {:.10g}°", pilot_deg), FigureSize::third);
}

}  // namespace misalign::schema
