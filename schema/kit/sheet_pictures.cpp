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

// Fills and lines in the colours of the page's style, which has their weights.
constexpr const char* kPanel = "fill:var(--panel);stroke:var(--line)";
constexpr const char* kPlaced = "fill:var(--grid);stroke:var(--line)";
constexpr const char* kFront = "fill:var(--panel-front);stroke:var(--panel-edge)";
constexpr const char* kBack = "fill:var(--panel-back);stroke:var(--panel-edge)";
constexpr const char* kMountain = "stroke:var(--mountain)";
constexpr const char* kValley = "stroke:var(--valley);stroke-dasharray:6 4";
constexpr const char* kDiagonal = "stroke:var(--grows);stroke-width:2.4px";

// A panel of a row: another hue for each of twelve rows.
std::string row_style(int row) {
  constexpr int kHues = 12, kStep_deg = 150;
  return fmt::format("fill:hsl({},var(--row-fill));stroke:var(--edge)",
                     row % kHues * kStep_deg % 360);
}

}  // namespace

std::string row_picture(const solver::Sheet& sheet, int row, const std::string& caption) {
  SvgPicture picture;
  const auto& panels = sheet.panels();
  const auto row_of = [&](std::size_t panel) {
    return sheet.base().sheet.places[static_cast<std::size_t>(panels.facets[panel])][0];
  };
  for (std::size_t p = 0; p < panels.facets.size(); ++p) {
    if (row_of(p) != row) picture.polygon(corners_mm(sheet, p), row_of(p) < row ? kPlaced : kPanel);
  }
  for (std::size_t p = 0; p < panels.facets.size(); ++p) {
    if (row_of(p) != row) continue;
    picture.polygon(corners_mm(sheet, p), row_style(row));
    picture.label(middle(corners_mm(sheet, p)), panel_label(sheet, panels.facets[p]));
  }
  return picture.figure(caption, FigureSize::half);
}

std::string bed_picture(const solver::Sheet& sheet, const Kit& kit, std::size_t bed) {
  SvgPicture picture;
  const Vector2d& size = kit.sheets.size_mm;
  picture.polygon({{0, 0}, {size.x(), 0}, size, {0, size.y()}}, "fill:none;stroke:var(--edge)");
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
      picture.polygon(corners, row_style(row));
      labels.emplace_back(middle(corners), panel_label(sheet, facet));
    }
  }
  for (const auto& [at_mm, words] : labels) picture.label(at_mm, words);
  for (const Vector2d& mark : kit.sheets.marks_mm) picture.dot(mark, 0.5 * kMark_mm);
  constexpr std::size_t kFew = 2;
  return picture.figure(fmt::format("Sheet of material {} of {}", bed + 1, kit.sheets.beds.size()),
                        kit.sheets.beds.size() <= kFew ? FigureSize::wide : FigureSize::half);
}

std::string assembled_picture(const solver::Sheet& sheet, const std::string& diagonals) {
  const solver::Mechanism& mechanism = sheet.mechanism();
  SvgPicture picture;
  for (std::size_t p = 0; p < sheet.panels().facets.size(); ++p) {
    picture.polygon(corners_mm(sheet, p), kPanel);
  }
  for (const solver::Crease& crease : mechanism.creases) {
    picture.line(sheet.point_mm(crease.a), sheet.point_mm(crease.b),
                 mechanism.is_valley(crease) ? kValley : kMountain);
  }
  // Labels of diagonals lie near their upper ends, apart from their crossing and from the labels
  // above ball joints.
  constexpr double kLabel = 0.22;
  for (int d = 0; d < mechanism.diagonal_count(); ++d) {
    const solver::Diagonal& diagonal = mechanism.diagonals[static_cast<std::size_t>(d)];
    Vector2d from = sheet.point_mm(diagonal.from), to = sheet.point_mm(diagonal.to);
    picture.line(from, to, kDiagonal);
    if (from.y() < to.y()) std::swap(from, to);
    picture.label(from + kLabel * (to - from), "s" + std::to_string(d));
  }
  for (const solver::BallJoint& ball : mechanism.balls) {
    picture.dot(sheet.point_mm(ball.vertex), 0.05 * mechanism.panel_width_mm);
    picture.label(sheet.point_mm(ball.vertex) + Vector2d(0, 0.14 * mechanism.panel_width_mm),
                  solver::vertex_label(ball.vertex));
  }
  return "<div class=\"lines\">" +
         picture.figure("Sheet at flat. Mountains: red, solid; valleys: blue, dashed; " +
                            diagonals + ": green, thick; ball joints: orange dots",
                        FigureSize::wide) +
         "</div>\n";
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
    picture.polygon(panel.corners, panel.from_above ? kFront : kBack);
  }
  return picture.figure(fmt::format("Sheet at a pilot angle of {:.10g}°", pilot_deg),
                        FigureSize::third);
}

}  // namespace misalign::schema
