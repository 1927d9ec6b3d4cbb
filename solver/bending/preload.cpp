#include "solver/bending/preload.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Factor on panels' stiffness in their planes, with which these give less than 1e-3 of what bending
// does.
constexpr double kStiffer = 1e4;
// Panels do not bend in modes below this share of the largest eigenvalue; forces do not push below
// this share of the stiffest panel's.
constexpr double kNoPush = 1e-9;

// The flat sheet in equilibrium with its filling's forces in its plane.
Matrix3Xd settled_in_plane(const ElasticSheet& sheet, const Filling& filling) {
  Matrix3Xd at_mm = sheet.flat_shape_mm();
  const std::vector<int> held = sheet.supports(at_mm);
  std::vector<int> free;
  for (int i = 0; i < sheet.coordinates(); ++i) {
    if (i % 3 != 2 && !std::binary_search(held.begin(), held.end(), i)) free.push_back(i);
  }
  for (int step = 0; step < 4; ++step) {
    ElasticSheet::Energy energy = sheet.panels_energy(at_mm);
    sheet.add_filling(at_mm, filling, VectorXd::Zero(filling.diagonals()), energy);
    const MatrixXd bend = energy.bend(free, free);
    const VectorXd slope = energy.slope(free), moved = bend.ldlt().solve(slope);
    for (Index i = 0; i < moved.size(); ++i) {
      const int at = free[static_cast<std::size_t>(i)];
      at_mm(at % 3, at / 3) -= moved(i);
    }
  }
  return at_mm;
}

}  // namespace

std::optional<PreloadAtFlat> preload_at_flat(const Sheet& sheet, const PanelMaterial& material,
                                             double thickness_mm, const VectorXd& shares) {
  const ElasticSheet panels(sheet.vertices_mm(), sheet.panels(), sheet.mechanism().diagonals,
                            material, thickness_mm, kStiffer);
  const auto near = find_compliance(panels, sheet.at(kNearFlat_deg).vertices_mm);
  if (!near) return {};
  const double square = std::pow(kNearFlat_deg * kRadPerDeg, 2);
  const VectorXd longer = near->lengths_mm - panels.flat_lengths_mm();
  return PreloadAtFlat{shares.dot(longer) / square, shares.dot(near->mm_per_n * shares) / square};
}

FlatModes find_flat_modes(const ElasticSheet& sheet, const Filling& filling) {
  const Matrix3Xd at_mm = settled_in_plane(sheet, filling);
  ElasticSheet::Energy energy = sheet.panels_energy(at_mm);
  sheet.add_filling(at_mm, filling, VectorXd::Zero(filling.diagonals()), energy);
  const Index count = sheet.vertices();
  MatrixXd across(count, count), saddles(sheet.panels(), count);
  const MatrixXd slopes = sheet.saddle_slopes(at_mm);
  for (Index v = 0; v < count; ++v) {
    saddles.col(v) = slopes.col(3 * v + 2);
    for (Index w = 0; w < count; ++w) across(v, w) = energy.bend(3 * v + 2, 3 * w + 2);
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> bending(saddles.transpose() * saddles);
  const double least = kNoPush * bending.eigenvalues().maxCoeff();
  const Index rigid = (bending.eigenvalues().array() < least).count();
  const MatrixXd modes = bending.eigenvectors().leftCols(rigid);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> pushed(modes.transpose() * across * modes);
  const double push = kNoPush * sheet.saddle_n_per_mm().maxCoeff();
  constexpr int kOfSpace = 3;  // a shift and two turns
  return {static_cast<int>(rigid) - kOfSpace,
          static_cast<int>((pushed.eigenvalues().array() < -push).count())};
}

BestPreload best_preload(const BentWay& way, const VectorXd& rates_n_per_mm, double to_deg,
                         const PreloadAtFlat& at_flat, const VectorXd& shares) {
  const VectorXd& flat_mm = way.panels().flat_lengths_mm();
  // Shares are 0 where no spring is.
  const VectorXd taut_mm_per_n = VectorXd::NullaryExpr(shares.size(), [&](Index d) {
    return rates_n_per_mm(d) > 0 ? shares(d) / rates_n_per_mm(d) : 0;
  });
  const auto with = [&](double preload_n) {
    const Filling springs =
        Filling::of_springs(rates_n_per_mm, flat_mm - preload_n * taut_mm_per_n);
    const EnergyCurve curve = way.curve(springs, way.bend(springs, BendMethod::linear));
    return find_bent_friction(curve, to_deg, 0,
                              [](double) {
                                return OtherMoments{0, 0, 0};
                              })
        .static_n_mm_per_mm;
  };
  // Golden sections find the one maximum in between.
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double low = 0, high = at_flat.none_left_n();
  double lower = high - golden * (high - low), upper = low + golden * (high - low);
  double with_lower = with(lower), with_upper = with(upper);
  for (int k = 0; k < 24; ++k) {
    if (with_lower >= with_upper) {
      high = upper, upper = lower, with_upper = with_lower;
      lower = high - golden * (high - low);
      with_lower = with(lower);
    } else {
      low = lower, lower = upper, with_lower = with_upper;
      upper = low + golden * (high - low);
      with_upper = with(upper);
    }
  }
  const double best_n = (low + high) / 2, best = with(best_n);
  const double without = with(0);
  return best > without ? BestPreload{best_n, best} : BestPreload{0, without};
}

StudyResult<PreloadStudy> study_preload(const Sheet& sheet, const ReleaseOptions& deploying,
                                        const BentPanels& bent) {
  const Springs& springs = deploying.sheet.springs();
  const PanelMaterial& material = bent.options.material;
  const EnergyModel rigid(sheet, deploying.sheet);
  const double preload_n = springs.preload.largest_n();
  const VectorXd shares = rigid.filling().forces_n(sheet.way()->flat_mm()) / preload_n;
  const auto at_flat = preload_at_flat(sheet, material, bent.thickness_mm, shares);
  if (!at_flat) return NoResult::panels_not_stable;
  const double pilot_rate = sheet.way()->pilot_rate(0);
  const double mass = rigid.at(0).mass / (pilot_rate * pilot_rate),  // t mm^2 by the pilot's angle
      stiffness = std::max(0.0, at_flat->stiffness_n_mm(preload_n));
  return PreloadStudy{preload_n, *at_flat, find_flat_modes(bent.way->panels(), rigid.filling()),
                      best_preload(*bent.way, rigid.filling().rates_n_per_mm(), bent.options.to_deg,
                                   *at_flat, shares),
                      std::sqrt(stiffness / mass) / (2 * std::numbers::pi)};
}

}  // namespace misalign::solver
