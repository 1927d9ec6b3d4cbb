// Gaps of miscut copies against Newton's method on the panels' places, and where there are none.
#include "solver/play/miscut_gap.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "tests/solver/few_holes.hpp"

namespace misalign::solver {
namespace {

Eigen::Matrix2Xd random_errors(Eigen::Index vertices, double amplitude_mm, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-amplitude_mm, amplitude_mm);
  Eigen::Matrix2Xd errors(2, vertices);
  for (double& error : errors.reshaped()) error = uniform(random);
  return errors;
}

// With all holes every miscut copy folds; with fewer what keeps to the family does.
TEST(MiscutGap, IsNothingWhereCopiesFold) {
  const PerforatedSheet whole = TestSheet(6, 6).base;
  const Model square(whole);
  SheetSolver solver(square);
  const Sheet sheet(solver, member_of(whole, 0.4, true, 1));
  const std::vector<Eigen::Matrix2Xd> errors = {random_errors(49, 0.05, 1),
                                                random_errors(49, 0.05, 2)};
  EXPECT_LE(find_miscut_gaps(sheet, errors, {29, 89, 149}).open_mm.maxCoeff(), 1e-10);

  const PerforatedSheet few = with_holes({5});
  const Model overconstrained(few);
  SheetSolver other(overconstrained);
  const Sheet member(other, member_of(few, 4, true, 1));
  EXPECT_LE(
      find_miscut_gaps(member, {member_of(few, 0.05, true, 1)}, {29, 89, 149}).open_mm.maxCoeff(),
      1e-10);
  const MiscutGap gap = find_miscut_gaps(member, errors, {29, 89, 149});
  EXPECT_GE(gap.open_mm.minCoeff(), 1e-3);
  // To first order: twice the error is twice as far open.
  const MiscutGap twice = find_miscut_gaps(member, {2 * errors[0], 2 * errors[1]}, {29, 89, 149});
  EXPECT_LE((twice.open_mm - 2 * gap.open_mm).cwiseAbs().maxCoeff(), 1e-10);
}

// Vertices as unknowns: every panel's corners are a vertex of their own (four a panel), its edges
// and diagonals as cut and its corners in one plane; the sum of squares of what corners of
// neighbours lie apart is least where no panel can be moved to make it less.
TEST(MiscutGap, IsTheLeastOfAllPlaces) {
  const PerforatedSheet base = with_holes({0, 15});
  const Model model(base);
  SheetSolver solver(model);
  const Sheet sheet(solver, member_of(base, 3, true, 1));
  const Eigen::Matrix2Xd errors_mm = random_errors(49, 0.05, 7);
  const Eigen::Index row = 99;
  const double claimed_mm = find_miscut_gaps(sheet, {errors_mm}, {row}).open_mm(0, 0);

  SheetGeometry<double> geometry;
  place(model.mechanism(), sheet.vertices_mm(), geometry);
  FoldedShape::Points<double> folded;
  model.shape().place(geometry, sheet.states()[row].state, folded);
  const double width_mm = model.mechanism().panel_width_mm;
  // Each panel's rotation and place, by exact rotations; Gauss-Newton by differences.
  const std::vector<int>& facets = sheet.panels().facets;
  const Eigen::Index panels = std::ssize(facets);
  std::vector<Eigen::Isometry3d> poses;
  for (const int f : facets) {
    const Pose<double>& at = folded.facets[static_cast<std::size_t>(f)];
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() << at.rotation.cx.x, at.rotation.cy.x, at.rotation.cz.x, at.rotation.cx.y,
        at.rotation.cy.y, at.rotation.cz.y, at.rotation.cx.z, at.rotation.cy.z, at.rotation.cz.z;
    pose.translation() << at.translation.x, at.translation.y, at.translation.z;
    pose.translation() *= width_mm;
    poses.push_back(pose);
  }
  const auto corner = [&](const Eigen::Isometry3d& pose, int v) -> Eigen::Vector3d {
    const Eigen::Vector2d flat =
        sheet.vertices_mm().col(v) - sheet.vertices_mm().col(0) + errors_mm.col(v);
    return pose * Eigen::Vector3d(flat.x(), flat.y(), 0);
  };
  struct Held {
    int v;
    Eigen::Index one, other;
  };
  std::vector<Held> held;
  const auto panel = [&](int f) { return std::ranges::find(facets, f) - facets.begin(); };
  for (const Crease& c : model.mechanism().creases) {
    for (const int v : {c.a, c.b}) held.push_back({v, panel(c.left), panel(c.right)});
  }
  for (const BallJoint& b : model.mechanism().balls) {
    held.push_back({b.vertex, panel(b.from_facet), panel(b.to_facet)});
  }
  const auto moved = [&](const Eigen::VectorXd& by) {
    std::vector<Eigen::Isometry3d> to = poses;
    for (Eigen::Index p = 0; p < panels; ++p) {
      const Eigen::Vector3d turn = by.segment<3>(6 * p) / width_mm;  // by mm at a panel's width
      const double angle = turn.norm();
      if (angle > 0) {
        to[static_cast<std::size_t>(p)] =
            Eigen::AngleAxisd(angle, turn / angle) * to[static_cast<std::size_t>(p)];
      }
      to[static_cast<std::size_t>(p)].pretranslate(Eigen::Vector3d(by.segment<3>(6 * p + 3)));
    }
    return to;
  };
  const auto apart = [&](const std::vector<Eigen::Isometry3d>& at) {
    Eigen::VectorXd all(3 * std::ssize(held));
    for (Eigen::Index k = 0; k < std::ssize(held); ++k) {
      const Held& h = held[static_cast<std::size_t>(k)];
      all.segment<3>(3 * k) = corner(at[static_cast<std::size_t>(h.one)], h.v) -
                              corner(at[static_cast<std::size_t>(h.other)], h.v);
    }
    return all;
  };
  for (int round = 0; round < 3; ++round) {
    const Eigen::VectorXd here = apart(poses);
    Eigen::MatrixXd jacobian(here.size(), 6 * panels);
    for (Eigen::Index c = 0; c < jacobian.cols(); ++c) {
      const double step = 1e-4;
      jacobian.col(c) = (apart(moved(step * Eigen::VectorXd::Unit(6 * panels, c))) - here) / step;
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian,
                                                Eigen::ComputeThinU | Eigen::ComputeThinV);
    Eigen::VectorXd by = svd.matrixU().transpose() * here;
    // But for the six rigid motions and the sheet's own.
    const Eigen::Index moves = by.size() - 7;
    by.head(moves).array() /= svd.singularValues().head(moves).array();
    by.tail(7).setZero();
    poses = moved(-svd.matrixV() * by);
  }
  const Eigen::VectorXd left = apart(poses);
  double largest_mm = 0;
  for (Eigen::Index k = 0; k < left.size(); k += 3) {
    largest_mm = std::max(largest_mm, left.segment<3>(k).norm());
  }
  // Second order in 0.05 mm of 80.
  EXPECT_NEAR(claimed_mm, largest_mm, 0.01 * largest_mm);
  EXPECT_GT(largest_mm, 1e-3);
}

}  // namespace
}  // namespace misalign::solver
