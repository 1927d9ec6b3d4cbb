#include "solver/contact/plate_thickness.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
// Number of fold angles that are compared between two stations.
constexpr int kAnglesPerStation = 4;
// Number of places of the first guess of the least distance, which rules out most pairs at once.
constexpr int kGuesses = 6;

std::array<Vector3d, 4> corners_of(const Panels& panels, std::size_t panel,
                                   const FlatVertices& vertices_mm) {
  std::array<Vector3d, 4> corners_mm;
  for (std::size_t k = 0; k < 4; ++k) {
    corners_mm[k] << vertices_mm.col(panels.corners[panel][k]) - vertices_mm.col(0), 0;
  }
  return corners_mm;
}

// Reach of a trim of 1 along the edges: 1 / cos of half the corner's angle.
double reach_of(const std::array<Vector3d, 4>& corners_mm, std::size_t at) {
  const Vector3d before = (corners_mm[(at + 3) % 4] - corners_mm[at]).normalized();
  const Vector3d after = (corners_mm[(at + 1) % 4] - corners_mm[at]).normalized();
  return 2 / (before + after).norm();
}

// The part of a convex polygon that is on the left of the line through `on` along `along`, at least
// `far_mm` away from it.
PolygonCorners clipped(const PolygonCorners& polygon, const Vector3d& on, const Vector3d& along,
                       double far_mm) {
  const Vector3d left = Vector3d::UnitZ().cross(along.normalized());
  std::vector<Vector3d> kept;
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vector3d corner = polygon.col(k), next = polygon.col((k + 1) % polygon.cols());
    const double at = left.dot(corner - on) - far_mm, then = left.dot(next - on) - far_mm;
    if (at >= 0) kept.push_back(corner);
    if (at * then < 0) kept.push_back(corner + at / (at - then) * (next - corner));
  }
  PolygonCorners rest(3, std::min<Index>(static_cast<Index>(kept.size()), 8));
  for (Index k = 0; k < rest.cols(); ++k) rest.col(k) = kept[static_cast<std::size_t>(k)];
  return rest;
}

// Half the largest thickness whose tapers on one side leave something of a panel whole.
double half_thickness(const PolygonCorners& trimmed, const std::vector<FoldLine>& folds,
                      const std::vector<double>& tangents, const FlatVertices& vertices_mm) {
  assert(folds.size() == tangents.size());
  if (folds.empty()) return kUnlimited;
  const double size_mm = (trimmed.colwise() - trimmed.col(0)).colwise().norm().maxCoeff();
  double least = 0, most = size_mm;  // no fold of less than 90 degrees takes that away
  for (int k = 0; k < 60; ++k) {
    const double half_mm = (least + most) / 2;
    PolygonCorners rest = trimmed;
    for (std::size_t i = 0; i < folds.size() && rest.cols() > 0; ++i) {
      Vector3d a, b;
      a << vertices_mm.col(folds[i].a) - vertices_mm.col(0), 0;
      b << vertices_mm.col(folds[i].b) - vertices_mm.col(0), 0;
      rest = clipped(rest, a, b - a, half_mm * tangents[i]);
    }
    (rest.cols() > 0 ? least : most) = half_mm;
  }
  return least;
}

std::vector<double> largest_angles(const Panels& panels, const PanelMotion& motion, double end) {
  assert(end >= 0);
  std::vector<double> largest(panels.folds.size());
  const int angles = static_cast<int>(std::ceil(kAnglesPerStation * end / motion.step()));
  for (int k = 1; k <= angles; ++k) {
    for (std::size_t crease = 0; crease < largest.size(); ++crease) {
      const double rho = motion.crease_rad(end * k / angles, static_cast<int>(crease));
      largest[crease] = std::max(largest[crease], std::abs(rho));
    }
  }
  return largest;
}

}  // namespace

std::vector<std::array<bool, 4>> trimmed_corners(const Panels& panels) {
  std::vector<std::array<bool, 4>> trimmed(panels.corners.size());
  for (const PanelPair& pair : pairs_of(panels)) {
    if (pair.kind != ContactKind::vertex) continue;
    for (const int panel : {pair.a, pair.b}) {
      trimmed[panel][corner_of(panels.corners[panel], pair.joint)] = true;
    }
  }
  return trimmed;
}

std::vector<PolygonCorners> trimmed_panels(const Panels& panels, const FlatVertices& vertices_mm,
                                           double trim_mm) {
  const auto trimmed = trimmed_corners(panels);
  std::vector<PolygonCorners> outlines;
  for (std::size_t panel = 0; panel < trimmed.size(); ++panel) {
    const auto corners_mm = corners_of(panels, panel, vertices_mm);
    PolygonCorners outline(
        3, 4 + (trim_mm > 0 ? std::count(trimmed[panel].begin(), trimmed[panel].end(), true) : 0));
    Index next = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!trimmed[panel][k] || !(trim_mm > 0)) {
        outline.col(next++) = corners_mm[k];
        continue;
      }
      const double along_mm = trim_mm * reach_of(corners_mm, k);
      for (const std::size_t other : {(k + 3) % 4, (k + 1) % 4}) {
        outline.col(next++) =
            corners_mm[k] + along_mm * (corners_mm[other] - corners_mm[k]).normalized();
      }
    }
    assert(next == outline.cols());
    outlines.push_back(outline);
  }
  return outlines;
}

double largest_trim_mm(const Panels& panels, const FlatVertices& vertices_mm) {
  const auto trimmed = trimmed_corners(panels);
  double largest_mm = kUnlimited;
  for (std::size_t panel = 0; panel < trimmed.size(); ++panel) {
    const auto corners_mm = corners_of(panels, panel, vertices_mm);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      double reach = 0;
      for (const std::size_t at : {k, next}) {
        if (trimmed[panel][at]) reach += reach_of(corners_mm, at);
      }
      if (reach > 0) {
        largest_mm = std::min(largest_mm, (corners_mm[next] - corners_mm[k]).norm() / reach);
      }
    }
  }
  return largest_mm;
}

PlateThickness::Taper taper_limit(const Panels& panels, const std::vector<PolygonCorners>& trimmed,
                                  const FlatVertices& vertices_mm,
                                  const std::vector<double>& largest_rad) {
  PlateThickness::Taper limit{kUnlimited, -1};
  for (std::size_t panel = 0; panel < trimmed.size(); ++panel) {
    for (const int side : {1, -1}) {
      std::vector<FoldLine> folds;  // the panel is on their left
      std::vector<double> tangents;
      for (std::size_t k = 0; k < panels.folds.size(); ++k) {
        FoldLine fold = panels.folds[k];
        if (fold.sign != side) continue;
        if (fold.right == static_cast<int>(panel)) {
          std::swap(fold.a, fold.b);
          std::swap(fold.left, fold.right);
        }
        if (fold.left != static_cast<int>(panel)) continue;
        folds.push_back(fold);
        tangents.push_back(largest_rad[k] < kPi ? std::tan(largest_rad[k] / 2) : kUnlimited);
      }
      const double both_mm = 2 * half_thickness(trimmed[panel], folds, tangents, vertices_mm);
      if (both_mm < limit.thickness_mm) limit = {both_mm, static_cast<int>(panel)};
    }
  }
  return limit;
}

PlateThickness largest_thickness(const Panels& panels, const PanelMotion& motion, double end,
                                 double trim_mm) {
  const FlatVertices& vertices_mm = motion.way().from_a1_mm();
  const auto trimmed = trimmed_panels(panels, vertices_mm, trim_mm);
  PlateThickness result{};
  result.largest_rad = largest_angles(panels, motion, end);
  const auto taper = taper_limit(panels, trimmed, vertices_mm, result.largest_rad);

  std::vector<std::pair<PolygonWalk, PanelPair>> walks;
  double least_mm = kUnlimited, at_x = 0;
  for (const PanelPair& pair : pairs_of(panels)) {
    if (pair.kind == ContactKind::crease) continue;
    walks.emplace_back(
        PolygonWalk(motion, pair.a, pair.b, trimmed[static_cast<std::size_t>(pair.a)],
                    trimmed[static_cast<std::size_t>(pair.b)]),
        pair);
  }
  for (int k = 1; k <= kGuesses; ++k) {
    const double x = end * k / kGuesses;
    for (auto& [walk, pair] : walks) {
      if (walk.least_mm(x) >= least_mm) continue;
      const double gap_mm = walk.move_to(x);
      if (gap_mm >= least_mm) continue;
      least_mm = std::max(gap_mm, 0.0);
      at_x = x;
      result.pair = pair;
    }
  }
  for (auto& [walk, pair] : walks) {
    if (least_mm <= 0) break;
    if (lower_to_least(walk, {kThicknessSlack}, end, least_mm, at_x)) result.pair = pair;
  }
  result.clear_mm = (1 - kThicknessSlack) * std::max(least_mm, 0.0);
  result.taper_mm = taper.thickness_mm;
  result.panel = taper.panel;
  result.pilot_deg = motion.way().pilot_deg(at_x);
  result.thickness_mm = std::min(result.clear_mm, result.taper_mm);
  using Limit = PlateThickness::Limit;
  result.limit = result.taper_mm < result.clear_mm         ? Limit::taper
                 : result.pair.kind == ContactKind::vertex ? Limit::vertex
                                                           : Limit::apart;
  return result;
}

}  // namespace misalign::solver
