#include "solver/optimise/path_gradients.hpp"

#include <Eigen/QR>
#include <cassert>
#include <cmath>

#include "solver/linear/newton.hpp"
#include "solver/model/flat_gradient.hpp"

namespace misalign::solver {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

namespace {

// First step along the curve from a state near it; tolerances of the corrections and of the pilot's
// rate at its limit.
constexpr double kFirstAlong_rad = 1e-3, kOnCurve_rad = 1e-10, kStill = 1e-9;
constexpr int kMostToLimit = 60;
// Marching to a limit: the first and the shortest step, the largest correction of a step as a share
// of it, and steps.
constexpr double kFirstMarch_rad = 0.02, kShortestMarch_rad = 1e-5, kMarchShare = 0.2;
constexpr int kMostMarches = 400;
// Shift of shapes along the gradient: between rounding and curvature, both 1e-10 of a gradient.
constexpr double kNextShape_mm = 1e-4;

}  // namespace

struct PathGradients::Workspace {
  explicit Workspace(const Sheet& sheet)
      : mechanism(sheet.mechanism()),
        system(mechanism),
        lu(system),
        gradient(mechanism),
        state(sheet.way()->stations().front().state),
        rates(mechanism.unknowns) {
    place(mechanism, sheet.vertices_mm(), geometry);
  }

  Index coordinates() const { return 2 * Index{mechanism.vertices}; }

  // Completes the gradient of a quantity whose derivatives by the unknowns are `rates`: subtracts
  // the part by which the unknowns keep the loops closed.
  void hold_closed(VectorXd& of_quantity) {
    assert(of_quantity.size() == coordinates());
    const VectorXd weights = -lu.solve_transposed(rates.head(mechanism.equations));
    gradient.add_closure(weights.data(), of_quantity.data());
  }

  // The shortest step onto the curve, and the curve's unit tangent at the state.
  struct OnCurve {
    VectorXd closing, tangent;
    double pilot_rate() const { return tangent(tangent.size() - 1); }
  };
  OnCurve on_curve() {
    const int n = mechanism.equations;
    system.evaluate(geometry, state);
    const Eigen::HouseholderQR<MatrixXd> qr(system.jacobian().transpose());
    VectorXd step = VectorXd::Zero(n + 1);
    step.head(n) = -qr.matrixQR().topRows(n).triangularView<Eigen::Upper>().transpose().solve(
        system.residual());
    return {qr.householderQ() * step, qr.householderQ() * VectorXd::Unit(n + 1, n)};
  }

  // Brings the state from near the limit to it: onto the curve by the shortest step, along it by
  // secants of the pilot's rate.
  bool reach_limit() {
    VectorXd tangent;
    double along_rad = kFirstAlong_rad, last_rate = 0;
    for (int k = 0; k < kMostToLimit; ++k) {
      OnCurve now = on_curve();
      advance(mechanism, now.closing.data(), state);
      if (now.closing.norm() > kOnCurve_rad) continue;
      if (tangent.size() > 0 && now.tangent.dot(tangent) < 0) now.tangent = -now.tangent;
      const double rate = now.pilot_rate();
      if (std::abs(rate) < kStill) return true;
      if (tangent.size() > 0) along_rad *= -rate / (rate - last_rate);
      last_rate = rate;
      tangent = now.tangent;
      const VectorXd forward = along_rad * now.tangent;
      advance(mechanism, forward.data(), state);
    }
    return false;
  }

  // Marches from a state on the curve to one next to the limit ahead: the last before the pilot
  // turns, by steps that end there.
  bool march_to_limit() {
    VectorXd tangent = on_curve().tangent;
    if (tangent(tangent.size() - 1) < 0) tangent = -tangent;
    double step_rad = kFirstMarch_rad;
    for (int k = 0; k < kMostMarches && step_rad > kShortestMarch_rad; ++k) {
      const FoldState<double> before = state;
      const VectorXd forward = step_rad * tangent;
      advance(mechanism, forward.data(), state);
      OnCurve now = on_curve();
      bool is_near = now.closing.norm() < kMarchShare * step_rad;
      for (int closing = 0; is_near && closing < kMostToLimit; ++closing) {
        advance(mechanism, now.closing.data(), state);
        if (now.closing.norm() < kOnCurve_rad) break;
        now = on_curve();
      }
      if (now.tangent.dot(tangent) < 0) now.tangent = -now.tangent;
      is_near = is_near && now.tangent.dot(tangent) > 1 - kMarchShare;
      if (is_near && now.pilot_rate() > 0) {
        tangent = now.tangent;
        continue;
      }
      // The pilot has turned, or the step was too long.
      state = before;
      if (is_near && step_rad < kFirstAlong_rad) return true;
      step_rad /= 2;
    }
    return step_rad <= kShortestMarch_rad;
  }

  const Mechanism& mechanism;
  ClosureSystem system;
  PivotedJacobian lu;
  FlatGradient<double> gradient;
  SheetGeometry<double> geometry;
  FoldState<double> state;
  VectorXd rates;
};

PathGradients::PathGradients(const Sheet& sheet) : sheet_(sheet) {
  assert(sheet.way() && !sheet.model().is_overconstrained());
  workspace_ = std::make_unique<Workspace>(sheet);
}

PathGradients::~PathGradients() = default;

bool PathGradients::solve_at(double pilot_deg) {
  const Sheet::Pose& pose = sheet_.at(pilot_deg);
  workspace_->state = pose.state;
  return pose.is_closed;
}

std::optional<PathGradients::AtAngle> PathGradients::at(double pilot_deg, bool with_folds) {
  Workspace& with = *workspace_;
  const Mechanism& mechanism = with.mechanism;
  const FoldingWay& way = *sheet_.way();
  const Index diagonals = mechanism.diagonal_count(), creases = std::ssize(mechanism.creases);
  AtAngle gradients{pilot_deg, way.flat_mm(), MatrixXd::Zero(diagonals, with.coordinates()),
                    VectorXd::Zero(creases), MatrixXd::Zero(creases, with.coordinates())};
  if (pilot_deg == 0) {
    for (Index d = 0; d < diagonals; ++d) {
      VectorXd row = VectorXd::Zero(with.coordinates());
      add_flat_length(mechanism, with.geometry, mechanism.diagonals[static_cast<std::size_t>(d)],
                      1.0, row.data());
      gradients.length_by_mm.row(d) = row.transpose();
    }
    return gradients;
  }
  if (!solve_at(pilot_deg)) return {};
  with.system.evaluate(with.geometry, with.state);
  with.lu.factorize();
  with.gradient.at(with.geometry, with.state);
  VectorXd row(with.coordinates());
  for (Index d = 0; d < diagonals; ++d) {
    const int diagonal = static_cast<int>(d);
    gradients.length_mm(d) = with.gradient.length(diagonal) * mechanism.panel_width_mm;
    with.gradient.of_unknowns(diagonal, with.rates.data());
    row.setZero();
    with.gradient.add_length(diagonal, row.data());
    with.hold_closed(row);
    gradients.length_by_mm.row(d) = row.transpose();
  }
  if (!with_folds) return gradients;
  gradients.fold_deg = sheet_.at(pilot_deg).fold_deg;
  const double deg_per_mm = 1 / (kRadPerDeg * mechanism.panel_width_mm);
  for (Index c = 0; c < creases; ++c) {
    const auto crease = static_cast<std::size_t>(c);
    if (static_cast<int>(crease) == mechanism.pilot) continue;
    with.rates.setZero();
    with.rates(mechanism.creases[crease].column) = mechanism.side * deg_per_mm;
    row.setZero();
    with.hold_closed(row);
    gradients.fold_by_mm.row(c) = row.transpose();
  }
  return gradients;
}

std::optional<PathGradients::Slopes> PathGradients::slopes(double pilot_deg) {
  Slopes gradients{VectorXd::Zero(sheet_.mechanism().diagonal_count()), {}};
  gradients.slope_by_mm.setZero(gradients.slope_mm_per_rad.size(), workspace_->coordinates());
  constexpr struct {
    int steps;
    double weight;
  } kDifferences[] = {{-2, 1}, {-1, -8}, {1, 8}, {2, -1}};  // over 12 steps
  for (const auto& [steps, weight] : kDifferences) {
    const double there_deg = pilot_deg + steps * kSlopeStep_rad / kRadPerDeg;
    // The mirror image lies on the other side of flat.
    const bool is_on = std::abs(there_deg) <= sheet_.way()->end_deg() &&
                       (there_deg >= 0 || sheet_.mechanism().springs.in_mid_plane());
    const auto there = is_on ? at(std::abs(there_deg), false) : std::nullopt;
    if (!there) return {};
    gradients.slope_mm_per_rad += weight / (12 * kSlopeStep_rad) * there->length_mm;
    gradients.slope_by_mm += weight / (12 * kSlopeStep_rad) * there->length_by_mm;
  }
  return gradients;
}

// Derivatives of the unknowns by each coordinate, column by column of the identity, and with these
// the shapes on either side.
std::optional<PathGradients::Shape> PathGradients::vertices(double pilot_deg) {
  if (!solve_at(pilot_deg)) return {};
  Workspace& with = *workspace_;
  const Mechanism& mechanism = with.mechanism;
  const Index equations = mechanism.equations, coordinates = with.coordinates();
  with.system.evaluate(with.geometry, with.state);
  with.gradient.at(with.geometry, with.state);
  MatrixXd closure_by_mm = MatrixXd::Zero(equations, coordinates);
  VectorXd row(coordinates);
  for (Index e = 0; e < equations; ++e) {
    const VectorXd weights = VectorXd::Unit(equations, e);
    row.setZero();
    with.gradient.add_closure(weights.data(), row.data());
    closure_by_mm.row(e) = row.transpose();
  }
  // Closures are of a geometry in panel widths.
  with.lu.factorize();
  MatrixXd follow(equations, coordinates);
  for (Index k = 0; k < coordinates; ++k) {
    follow.col(k) = -with.lu.solve(closure_by_mm.col(k)) / mechanism.panel_width_mm;
  }
  const FoldedShape& shape = sheet_.model().shape();
  const auto shape_mm = [&](Index k, double by_mm) {
    FlatVertices flat_mm = sheet_.vertices_mm();
    flat_mm(k % 2, k / 2) += by_mm;
    SheetGeometry<double> geometry;
    place(mechanism, flat_mm, geometry);
    FoldState<double> state = with.state;
    VectorXd step = VectorXd::Zero(mechanism.unknowns);
    step.head(equations) = by_mm * follow.col(k);
    advance(mechanism, step.data(), state);
    return shape.vertices_mm(geometry, state);
  };
  Shape folded{shape.vertices_mm(with.geometry, with.state), {}};
  folded.by_mm.resize(folded.at_mm.size(), coordinates);
  for (Index k = 0; k < coordinates; ++k) {
    const Eigen::Matrix3Xd by_mm =
        (shape_mm(k, kNextShape_mm) - shape_mm(k, -kNextShape_mm)) / (2 * kNextShape_mm);
    folded.by_mm.col(k) = by_mm.reshaped();
  }
  return folded;
}

std::optional<PathGradients::AtLimit> PathGradients::fold_limit() {
  Workspace& with = *workspace_;
  const FoldingWay& way = *sheet_.way();
  if (!way.ends_at_limit()) return {};
  way.find_state(way.end(), with.state);
  if (!with.reach_limit()) {
    with.state = way.stations().back().state;
    if (!with.march_to_limit() || !with.reach_limit()) return {};
  }
  with.gradient.at(with.geometry, with.state);
  const int equations = with.mechanism.equations;
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(with.system.jacobian().leftCols(equations));
  const VectorXd null = qr.householderQ() * VectorXd::Unit(equations, equations - 1);
  VectorXd row = VectorXd::Zero(with.coordinates());
  with.gradient.add_closure(null.data(), row.data());
  const double by_pilot = null.dot(with.system.jacobian().col(equations));
  const double per_mm = 1 / (kRadPerDeg * with.mechanism.panel_width_mm);
  return AtLimit{way.end_deg(), -per_mm / by_pilot * row.transpose()};
}

}  // namespace misalign::solver
