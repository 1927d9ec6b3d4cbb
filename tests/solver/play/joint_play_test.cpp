// The play of ball joints beside panels that are moved as rigid bodies, and beside an arc.
#include "solver/play/joint_play.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

using Eigen::Vector3d;

struct FoldedBalls {
  explicit FoldedBalls(int size)
      : made(size, size),
        own(made.base, Eigen::Matrix2Xd::Zero(2, made.base.sheet.vertex_count())) {}

  // The motion of a panel from flat to a row, by all of its corners.
  Eigen::Isometry3d moved(int facet, Eigen::Index row) const {
    Eigen::Matrix<double, 3, 4> from = Eigen::Matrix<double, 3, 4>::Zero(), to;
    for (int k = 0; k < 4; ++k) {
      const int v =
          made.base.sheet.facets[static_cast<std::size_t>(facet)][static_cast<std::size_t>(k)];
      from.col(k).head<2>() = own.sheet.point_mm(v);
      to.col(k) = own.sheet.shapes_mm()[static_cast<std::size_t>(row)].col(v);
    }
    return Eigen::Isometry3d(Eigen::umeyama(from, to, false));
  }
  // A point on the bisector of a panel's corner, so far from both sides.
  Vector3d inside(int facet, int vertex, double away_mm) const {
    const auto& around = made.base.sheet.facets[static_cast<std::size_t>(facet)];
    const auto k = static_cast<std::size_t>(std::ranges::find(around, vertex) - around.begin());
    const Eigen::Vector2d at = own.sheet.point_mm(vertex),
                          next = (own.sheet.point_mm(around[(k + 1) % 4]) - at).normalized(),
                          last = (own.sheet.point_mm(around[(k + 3) % 4]) - at).normalized();
    // The point on both lines that are parallel to the sides.
    Eigen::Matrix2d sides;
    sides << -next.y(), next.x(), last.y(), -last.x();
    const Eigen::Vector2d place = at + sides.inverse() * Eigen::Vector2d(away_mm, away_mm);
    return {place.x(), place.y(), 0};
  }

  const TestSheet made;
  const OwnSheet own;
};

TEST(JointPlay, OfALoopIsTheApproachOfItsBoresAndTheWiresClearance) {
  const FoldedBalls folded(6);
  ASSERT_FALSE(folded.made.mechanism.balls.empty());
  const Eigen::Index rows = 90;
  double worst = 0;
  for (const BallJoint& ball : folded.own.sheet.mechanism().balls) {
    const Vector3d one = folded.inside(ball.from_facet, ball.vertex, 2.6),
                   other = folded.inside(ball.to_facet, ball.vertex, 2.6);
    double least = (one - other).norm(), most = least;
    for (Eigen::Index row = 0; row < rows; ++row) {
      const double apart =
          (folded.moved(ball.from_facet, row) * one - folded.moved(ball.to_facet, row) * other)
              .norm();
      least = std::min(least, apart);
      most = std::max(most, apart);
    }
    worst = std::max(worst, most - least + 0.2);
  }
  const JointPlay play = joint_play(folded.own.sheet, {}, rows);
  EXPECT_NEAR(play.play_mm, worst, 1e-6);
  EXPECT_GT(play.play_mm, 0.3);
  EXPECT_GE(play.ball, 0);
  EXPECT_NEAR(joint_play(folded.own.sheet, {}, 0).play_mm, 0.2, 1e-12);  // flat: the wire alone
}

TEST(JointPlay, OfATabIsTheShiftOfItsPivot) {
  const FoldedBalls folded(6);
  JointParts parts;
  parts.kind = JointKind::tab;
  parts.strip_mm = 3;
  const Eigen::Index rows = 60;
  double bent = 0;
  for (const BallJoint& ball : folded.own.sheet.mechanism().balls) {
    Vector3d at = Vector3d::Zero();
    at.head<2>() = folded.own.sheet.point_mm(ball.vertex);
    const Vector3d strip = ((folded.inside(ball.from_facet, ball.vertex, 1) - at).normalized() -
                            (folded.inside(ball.to_facet, ball.vertex, 1) - at).normalized())
                               .normalized();
    for (Eigen::Index row = 0; row < rows; ++row) {
      const Vector3d one = folded.moved(ball.from_facet, row).linear() * strip,
                     other = folded.moved(ball.to_facet, row).linear() * strip;
      bent = std::max(bent, std::acos(std::clamp(one.dot(other), -1.0, 1.0)));
    }
  }
  // An arc in short straight pieces: where the lines of the first and the last one meet.
  constexpr int kPieces = 20000;
  Eigen::Vector2d end(0, 0);
  for (int k = 0; k < kPieces; ++k) {
    const double angle = bent * (k + 0.5) / kPieces;
    end += 3.0 / kPieces * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  const double pivot = end.x() - end.y() / std::tan(bent);
  EXPECT_NEAR(joint_play(folded.own.sheet, parts, rows).play_mm, pivot - 1.5, 1e-6);
  EXPECT_EQ(joint_play(folded.own.sheet, parts, 0).play_mm, 0);
}

TEST(JointPlay, OfABallIsHalfItsClearance) {
  const FoldedBalls folded(6);
  JointParts parts;
  parts.kind = JointKind::ball;
  EXPECT_EQ(joint_play(folded.own.sheet, parts, 30).play_mm, 0.2);
}

}  // namespace
}  // namespace misalign::solver
