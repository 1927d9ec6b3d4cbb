#include "schema/kit/kit_hinges.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

namespace misalign::schema {
namespace {

// Normals of the panels by facet; they point up when the sheet is flat.
std::map<int, Eigen::Vector3d> normals_of(const solver::Panels& panels,
                                          const Eigen::Matrix3Xd& shape_mm) {
  std::map<int, Eigen::Vector3d> normals;
  for (std::size_t k = 0; k < panels.facets.size(); ++k) {
    const auto& v = panels.corners[k];
    const Eigen::Vector3d first = shape_mm.col(v[2]) - shape_mm.col(v[0]),
                          second = shape_mm.col(v[3]) - shape_mm.col(v[1]);
    normals[panels.facets[k]] = first.cross(second).normalized();
  }
  return normals;
}

// The gap at a loop's end, per thickness. A hinge half a thickness above both mid-planes, or below,
// moves the next plate by ±1/2 of the difference of their normals. Ball joints are in the
// mid-plane.
Eigen::Vector3d open_end(const solver::Mechanism& mechanism, const solver::Loop& loop,
                         const std::map<int, Eigen::Vector3d>& normals) {
  Eigen::Vector3d end = Eigen::Vector3d::Zero();
  for (const solver::Passage& passage : loop.passages) {
    if (passage.ball) continue;
    const solver::Crease& crease = mechanism.creases[static_cast<std::size_t>(passage.joint)];
    const double height = mechanism.is_valley(crease) ? 0.5 : -0.5;
    end += passage.sense * height * (normals.at(crease.left) - normals.at(crease.right));
  }
  return end;
}

}  // namespace

KitHinges::KitHinges(const solver::Sheet& sheet, bool valley, Eigen::Index rows)
    : name(valley ? "valley" : "mountain") {
  const solver::Mechanism& mechanism = sheet.mechanism();
  for (std::size_t k = 0; k < mechanism.creases.size(); ++k) {
    const solver::Crease& crease = mechanism.creases[k];
    if (mechanism.is_valley(crease) != valley) continue;
    ++count;
    length_mm += (sheet.point_mm(crease.a) - sheet.point_mm(crease.b)).norm();
    if (rows == 0) continue;
    const auto folds = sheet.history().fold_angle_deg.col(static_cast<Eigen::Index>(k)).head(rows);
    fold_deg = std::max(fold_deg, folds.cwiseAbs().maxCoeff());
  }
}

double KitHinges::gap_mm(double thickness_mm) const {
  return thickness_mm * std::tan(bevel_deg() * solver::kRadPerDeg);
}

std::string FaceHingeMisfit::place(const solver::Sheet& sheet) const {
  if (loop->hole < 0) return solver::vertex_label(loop->passages.front().vertex);
  const auto& [row, column] = sheet.base().sheet.places[static_cast<std::size_t>(loop->hole)];
  return fmt::format("the hole [{}, {}]", row, column);
}

FaceHingeMisfit face_hinge_misfit(const solver::Sheet& sheet, Eigen::Index rows) {
  FaceHingeMisfit worst;
  for (Eigen::Index row = 0; row < rows; ++row) {
    const auto normals =
        normals_of(sheet.panels(), sheet.shapes_mm()[static_cast<std::size_t>(row)]);
    for (const solver::Loop& loop : sheet.mechanism().loops) {
      const double per_mm = open_end(sheet.mechanism(), loop, normals).norm();
      if (per_mm > worst.per_mm) worst = {per_mm, &loop};
    }
  }
  return worst;
}

}  // namespace misalign::schema
