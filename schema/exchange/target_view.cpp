#include "schema/exchange/target_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/exchange/svg_picture.hpp"
#include "schema/files/base64.hpp"

namespace misalign::schema {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

// Points along either side of the grid, and its size over the sheet's.
constexpr Index kAcross = 17;
constexpr double kWider = 1.08;
// Steps to a height of the surface, and its least slope against the vertical.
constexpr int kSteps = 40;
constexpr double kLeastUp = 0.2;

// The surface's point over a place.
Vector3d point_over(const solver::TargetSurface& surface, double x, double y) {
  Vector3d at(x, y, 0);
  for (int step = 0; step < kSteps; ++step) {
    const solver::SurfaceDistance away = surface.distance(at);
    at.z() -= away.mm / std::max(away.normal.z(), kLeastUp);
  }
  return at;
}

// Points of the surface over and around the sheet.
Matrix3Xd surface_points(const solver::TargetSurface& surface, const Matrix3Xd& placed_mm) {
  const Eigen::Vector2d least = placed_mm.topRows<2>().rowwise().minCoeff(),
                        most = placed_mm.topRows<2>().rowwise().maxCoeff(),
                        middle = (least + most) / 2, half = kWider / 2 * (most - least);
  Matrix3Xd points_mm(3, kAcross * kAcross);
  const auto share = [](Index k) { return 2.0 * static_cast<double>(k) / (kAcross - 1) - 1; };
  for (Index i = 0; i < points_mm.cols(); ++i) {
    points_mm.col(i) = point_over(surface, middle.x() + share(i % kAcross) * half.x(),
                                  middle.y() + share(i / kAcross) * half.y());
  }
  return points_mm;
}

// Colours run from a pale green through yellow to a dark red, ever darker.
std::string colour_of(double share) {
  static constexpr double kStops[][3] = {{237, 248, 233}, {254, 217, 118}, {177, 0, 38}};
  const double at = 2 * std::clamp(share, 0.0, 1.0);
  const int below = at < 1 ? 0 : 1;
  const auto mixed = [&](int k) {
    return kStops[below][k] + (at - below) * (kStops[below + 1][k] - kStops[below][k]);
  };
  return fmt::format("rgb({:.0f},{:.0f},{:.0f})", mixed(0), mixed(1), mixed(2));
}

// A polygon in the picture, with its nearness.
struct Face {
  double nearness;
  std::vector<Eigen::Vector2d> corners;
  std::string style;
};

Face face_of(const std::vector<Vector3d>& corners_mm, std::string style) {
  Face face{0, {}, std::move(style)};
  for (const Vector3d& corner_mm : corners_mm) {
    const Vector3d seen = seen_from_aside(corner_mm);
    face.nearness += seen.z() / static_cast<double>(corners_mm.size());
    face.corners.emplace_back(seen.head<2>());
  }
  return face;
}

}  // namespace

TargetView target_view(const solver::Panels& panels, const Matrix3Xd& vertices_mm,
                       const solver::ShapeMeasure& measure) {
  TargetView view;
  view.pose = measure.pose(vertices_mm);
  view.placed_mm = view.pose.placed(vertices_mm);
  view.columns = kAcross;
  const solver::ShapeTarget& target = measure.target();
  if (target.surface) view.surface_mm = surface_points(*target.surface, view.placed_mm);
  const solver::ShapeMisfit off = misfit(target, vertices_mm, view.pose);
  const Eigen::VectorXd distances_mm = off.distances_mm();
  view.panels_mm = Eigen::VectorXd::Zero(std::ssize(panels.corners));
  for (Index panel = 0; panel < view.panels_mm.size(); ++panel) {
    const auto& corners = panels.corners[static_cast<std::size_t>(panel)];
    for (Index k = 0; k < distances_mm.size(); ++k) {
      const bool is_on =
          std::ranges::any_of(corners, [&](int v) { return target.weights(k, v) != 0; });
      if (is_on) view.panels_mm(panel) = std::max(view.panels_mm(panel), distances_mm(k));
    }
  }
  view.rms_mm = off.rms_mm();
  view.max_mm = off.max_mm();
  return view;
}

Json target_shown_json(const solver::Sheet& sheet, const solver::ShapeMeasure& measure) {
  const auto row = sheet.row_at(measure.at_deg());
  if (!row || !measure.target().surface) return nullptr;
  const TargetView view =
      target_view(sheet.panels(), sheet.shapes_mm()[static_cast<std::size_t>(*row)], measure);
  const Eigen::Matrix2Xd& flat_mm = sheet.vertices_mm();
  Vector3d centre_mm = Vector3d::Zero();
  centre_mm.head<2>() = (flat_mm.rowwise().minCoeff() + flat_mm.rowwise().maxCoeff()) / 2;
  std::vector<float> points;
  for (const auto& on : view.surface_mm.colwise()) {
    const Vector3d seen = view.pose.turn.transpose() * (on - view.pose.move_mm) - centre_mm;
    for (const double mm : seen) points.push_back(static_cast<float>(mm));
  }
  return {{"pilot_deg", measure.at_deg()},
          {"columns", view.columns},
          {"points_mm", base64(points)},
          {"panels_mm", std::vector<double>(view.panels_mm.begin(), view.panels_mm.end())},
          {"rms_mm", view.rms_mm},
          {"max_mm", view.max_mm}};
}

std::string shape_picture(const std::string& title, const solver::Panels& panels,
                          const TargetView& view) {
  std::vector<Face> faces;
  const auto point = [&](Index k) -> Vector3d { return view.surface_mm.col(k); };
  const Index rows = view.surface_mm.cols() / view.columns;
  for (Index i = 0; i + 1 < rows; ++i) {
    for (Index k = i * view.columns; k + 1 < (i + 1) * view.columns; ++k) {
      faces.push_back(face_of(
          {point(k), point(k + 1), point(k + 1 + view.columns), point(k + view.columns)},
          "fill:#4a90d9;fill-opacity:.14;stroke:#4a90d9;stroke-opacity:.35;stroke-width:.3"));
    }
  }
  for (std::size_t panel = 0; panel < panels.corners.size(); ++panel) {
    std::vector<Vector3d> corners_mm;
    for (const int vertex : panels.corners[panel]) corners_mm.push_back(view.placed_mm.col(vertex));
    const double share =
        view.max_mm > 0 ? view.panels_mm(static_cast<Index>(panel)) / view.max_mm : 0;
    faces.push_back(face_of(
        corners_mm, "fill:" + colour_of(share) +
                        ";fill-opacity:.92;stroke:#333;stroke-width:.6;stroke-linejoin:round"));
  }
  std::ranges::stable_sort(faces, {}, &Face::nearness);
  SvgPicture picture;
  for (const Face& face : faces) picture.polygon(face.corners, face.style);
  // A bar of colours under the sheet, with the distances at its ends.
  const Eigen::Vector2d least = picture.least(), size = picture.most() - least;
  const double height = 0.02 * size.x(), text = height;
  const Eigen::Vector2d start(least.x() + 0.25 * size.x(), least.y() - 3 * height);
  constexpr int kParts = 24;
  const double part = size.x() / 2 / kParts;
  for (int k = 0; k < kParts; ++k) {
    const Eigen::Vector2d a = start + Eigen::Vector2d(k * part, 0), b(part, 0), c(0, height);
    picture.polygon({a, a + b, a + b + c, a + c}, "fill:" + colour_of((k + 0.5) / kParts));
  }
  const double under = start.y() - 1.5 * height;
  picture.text({start.x(), under}, "0", text);
  picture.text({start.x() + kParts * part, under}, fmt::format("{:.2g} mm", view.max_mm), text);
  picture.text({start.x() + kParts * part / 2, under - 1.5 * height},
               fmt::format("distance from the target; {:.2g} mm rms", view.rms_mm), text);
  return picture.file(title);
}

}  // namespace misalign::schema
