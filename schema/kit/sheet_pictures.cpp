#include "schema/kit/sheet_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "schema/exchange/svg_picture.hpp"
#include "schema/kit/kit_parts.hpp"

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

}  // namespace

std::string exploded_picture(const solver::Sheet& sheet) {
  constexpr double kApart = 0.25;
  SvgPicture picture;
  const Vector2d centre =
      0.5 * (sheet.vertices_mm().rowwise().minCoeff() + sheet.vertices_mm().rowwise().maxCoeff());
  for (std::size_t p = 0; p < sheet.panels().facets.size(); ++p) {
    std::vector<Vector2d> corners = corners_mm(sheet, p);
    const Vector2d offset = kApart * (middle(corners) - centre);
    for (Vector2d& at : corners) at += offset;
    picture.polygon(corners, "fill:#eef;stroke:#333;stroke-width:.6");
    picture.text(middle(corners), panel_label(sheet, sheet.panels().facets[p]),
                 0.18 * sheet.mechanism().panel_width_mm);
  }
  return picture.figure("Exploded view of the panels", true);
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
    picture.text(from + 0.3 * (to - from), "s" + std::to_string(d),
                 0.14 * mechanism.panel_width_mm);
  }
  for (const solver::BallJoint& ball : mechanism.balls) {
    picture.dot(sheet.point_mm(ball.vertex), 0.05 * mechanism.panel_width_mm);
    picture.text(sheet.point_mm(ball.vertex) + Vector2d(0, 0.08 * mechanism.panel_width_mm),
                 solver::vertex_label(ball.vertex), 0.14 * mechanism.panel_width_mm);
  }
  return picture.figure(
      "Mountains: red; valleys: blue, dashed; " + diagonals + ": green; ball joints: dots", true);
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
  return picture.figure(fmt::format("Pilot angle {:.10g}°", pilot_deg), false);
}

}  // namespace misalign::schema
