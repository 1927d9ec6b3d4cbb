#include "schema/kit/kit_hinges.hpp"

#include <algorithm>
#include <cmath>

namespace misalign::schema {

KitHinges::KitHinges(const solver::Sheet& sheet, bool valley, Eigen::Index rows)
    : name(valley ? "valley" : "mountain"), face(valley ? "looks up" : "looks down") {
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

}  // namespace misalign::schema
