// Clearance of springs, against distances by a search over vertex coordinates, closed forms of
// parallelograms, and a sweep in small steps.
#include "solver/contact/spring_clearance.hpp"

#include <gtest/gtest.h>

#include <random>

#include "solver/contact/plate_thickness.hpp"
#include "solver/kinematics/folded_springs.hpp"
#include "tests/solver/few_holes.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/own_spring_ends.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Line = std::array<Vector3d, 2>;

// The least value of a convex function between 0 and 1, by thirds.
template <class Function>
double least_of(const Function& function) {
  double from = 0, to = 1;
  for (int k = 0; k < 90; ++k) {
    const double third = (to - from) / 3;
    if (function(from + third) < function(to - third)) {
      to -= third;
    } else {
      from += third;
    }
  }
  return function((from + to) / 2);
}

double point_to_line(const Vector3d& point, const Vector3d& from, const Vector3d& to) {
  return least_of([&](double t) { return (from + t * (to - from) - point).norm(); });
}

double line_to_line(const Line& a, const Line& b) {
  return least_of([&](double s) { return point_to_line(a[0] + s * (a[1] - a[0]), b[0], b[1]); });
}

// Distance of a point from a plane convex polygon: its height over the plane inside, else to the
// nearest edge.
double point_to_polygon(const Vector3d& point, const std::vector<Vector3d>& polygon) {
  Vector3d normal = Vector3d::Zero();
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    normal += (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]);
  }
  normal.normalize();
  bool is_inside = true;
  double to_edges = 1e300;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector3d &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    is_inside = is_inside && normal.dot((to - from).cross(point - from)) >= 0;
    to_edges = std::min(to_edges, point_to_line(point, from, to));
  }
  return is_inside ? std::abs(normal.dot(point - polygon[0])) : to_edges;
}

double line_to_polygon(const Line& line, const std::vector<Vector3d>& polygon) {
  return least_of(
      [&](double s) { return point_to_polygon(line[0] + s * (line[1] - line[0]), polygon); });
}

Vector3d some_point(std::mt19937& random) {
  std::uniform_real_distribution<double> within(-1, 1);
  return {within(random), within(random), within(random)};
}

PolygonCorners as_corners(const Line& line) {
  PolygonCorners corners(3, 2);
  corners << line[0], line[1];
  return corners;
}

// Also parallel ones, lines that cross, and lines that share an end.
TEST(SpringDistance, IsThatOfASearchOverBothLines) {
  std::mt19937 random(3);
  for (int k = 0; k < 400; ++k) {
    const Line a{some_point(random), some_point(random)};
    Line b{some_point(random), some_point(random)};
    if (k % 4 == 1) b[1] = b[0] + 0.7 * (a[1] - a[0]);
    if (k % 4 == 2) b[1] = 1.3 * a[0] + 0.7 * a[1] - b[0];
    if (k % 4 == 3) b[1] = a[0];
    const Separation found = separation_of(as_corners(a), as_corners(b));
    // A search by thirds ends within 1e-8 of the place of a least distance.
    ASSERT_NEAR(found.distance, line_to_line(a, b), 1e-7) << k;
    ASSERT_NEAR((found.on_b - found.on_a).norm(), found.distance, 1e-14) << k;
  }
}

// The trimmed middle part of a diagonal's spring, by the coordinates of a folded sheet.
Line axis_of(const Mechanism& mechanism, const Eigen::Matrix3Xd& flat_mm,
             const Eigen::Matrix3Xd& folded_mm, int diagonal, double end_mm) {
  const Diagonal& of = mechanism.diagonals[static_cast<std::size_t>(diagonal)];
  const FoldedSpring spring(mechanism, of, folded_mm), flat(mechanism, of, flat_mm);
  const double share = end_mm / flat.length_mm();
  const Vector3d along = spring.to_mm - spring.from_mm;
  return {spring.from_mm + share * along, spring.to_mm - share * along};
}

struct SheetOfSprings {
  SheetOfSprings(const PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm)
      : own(base, shifts_mm), motion(resolved_motion(own.sheet).value()) {
    flat_mm = Eigen::Matrix3Xd::Zero(3, own.sheet.vertices_mm().cols());
    flat_mm.topRows<2>() = own.sheet.vertices_mm();
    outlines = trimmed_panels(own.sheet.panels(), own.sheet.vertices_mm(), kTrim_mm);
  }

  SpringClearance study(const SpringBodies& bodies, double end_deg,
                        const std::vector<double>& pilot_deg) const {
    return *spring_clearance(own.sheet, motion, outlines, bodies, motion.way().x_of(end_deg),
                             pilot_deg);
  }
  // Flat states are singular: they cannot be closed once more.
  Eigen::Matrix3Xd folded_mm(double pilot_deg) const {
    return pilot_deg == 0 ? flat_mm : own.sheet.at(pilot_deg).vertices_mm;
  }
  Line axis(int diagonal, double pilot_deg, double end_mm) const {
    return axis_of(own.sheet.mechanism(), flat_mm, folded_mm(pilot_deg), diagonal, end_mm);
  }
  // The trimmed panel, folded: its flat points by the coordinates of three corners.
  std::vector<Vector3d> outline(std::size_t panel, double pilot_deg) const {
    const Eigen::Matrix3Xd at_mm = folded_mm(pilot_deg);
    const std::array<int, 4>& corners = own.sheet.panels().corners[panel];
    const auto arm = [&](const Eigen::Matrix3Xd& of_mm, int k) -> Vector3d {
      return of_mm.col(corners[static_cast<std::size_t>(k)]) - of_mm.col(corners[0]);
    };
    Eigen::Matrix2d flat;
    flat << arm(flat_mm, 1).head<2>(), arm(flat_mm, 3).head<2>();
    std::vector<Vector3d> points;
    for (Index k = 0; k < outlines[panel].cols(); ++k) {
      const Vector3d from_corner =
          outlines[panel].col(k) - (flat_mm.col(corners[0]) - flat_mm.col(0));
      const Eigen::Vector2d parts = flat.inverse() * from_corner.head<2>();
      points.push_back(at_mm.col(corners[0]) + parts(0) * arm(at_mm, 1) + parts(1) * arm(at_mm, 3));
    }
    return points;
  }

  static constexpr double kTrim_mm = 5;
  const OwnSheet own;
  const PanelMotion motion;
  Eigen::Matrix3Xd flat_mm;
  std::vector<PolygonCorners> outlines;
};

Eigen::Matrix2Xd table1_mm(const TestSheet& sheet) {
  return sheet.shifted(golden("table1_odd.json")["displacements_mm"]) -
         sheet.base.sheet.vertices_mm;
}

Eigen::Matrix2Xd some_shifts(const TestSheet& sheet, double amplitude_mm, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(-amplitude_mm, amplitude_mm);
  Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, sheet.base.sheet.vertex_count());
  for (const int vertex : interior_vertices(sheet.base.sheet)) {
    shifts_mm.col(vertex) << within(random), within(random);
  }
  return shifts_mm;
}

void expect_distances_of_a_search(const SheetOfSprings& sheet, double end_deg) {
  const SpringBodies bodies{.diameter_mm = 4, .end_mm = 9};
  const std::vector<double> pilot_deg = {0, 20, end_deg / 2, end_deg};
  const SpringClearance study = sheet.study(bodies, end_deg, pilot_deg);
  const auto& diagonals = sheet.own.sheet.mechanism().diagonals;
  for (std::size_t k = 0; k < pilot_deg.size(); ++k) {
    double least_hole = 1e300, largest_hole = 0, springs = 1e300, panels = 1e300;
    for (std::size_t d = 0; d < diagonals.size(); ++d) {
      const Line axis = sheet.axis(static_cast<int>(d), pilot_deg[k], 9);
      for (std::size_t e = 0; e < d; ++e) {
        const double apart = line_to_line(axis, sheet.axis(static_cast<int>(e), pilot_deg[k], 9));
        if (diagonals[d].loop == diagonals[e].loop) {
          least_hole = std::min(least_hole, apart);
          largest_hole = std::max(largest_hole, apart);
        } else {
          springs = std::min(springs, apart);
        }
      }
      for (std::size_t panel = 0; panel < sheet.outlines.size(); ++panel) {
        panels = std::min(panels, line_to_polygon(axis, sheet.outline(panel, pilot_deg[k])));
      }
    }
    // Poses err by 1e-7 mm, searches by less than 1e-5 mm where lines cross.
    EXPECT_NEAR(study.apart[k].least_hole_mm, least_hole, 1e-5) << pilot_deg[k];
    EXPECT_NEAR(study.apart[k].largest_hole_mm, largest_hole, 1e-5) << pilot_deg[k];
    EXPECT_NEAR(study.apart[k].springs_mm, springs, 1e-5) << pilot_deg[k];
    EXPECT_NEAR(study.apart[k].panels_mm, panels, 1e-5) << pilot_deg[k];
  }
}

TEST(SpringClearance, DistancesAreThoseOfASearchOverCoordinates) {
  const TestSheet sheet{4, 4};
  expect_distances_of_a_search({sheet.base, some_shifts(sheet, 0.4, 5)}, 120);
  expect_distances_of_a_search({sheet.base, some_shifts(sheet, 4, 6)}, 60);
  TestSheet other{4, 4};
  other.base.springs = with_own(other.base, {8, 2}, -3);
  expect_distances_of_a_search({other.base, some_shifts(sheet, 0.4, 7)}, 90);
}

// Rates before flat are those of the smooth continuation of the motion, also off the mid-plane.
TEST(SpringClearance, RatesBeforeFlatContinueTheMotion) {
  TestSheet sheet{4, 4};
  sheet.base.springs = with_own(sheet.base, {8, 2}, -3);
  const SheetOfSprings of(sheet.base, some_shifts(sheet, 0.4, 7));
  const auto axes =
      spring_axes(of.own.sheet.mechanism(), of.own.sheet.panels(), of.motion.way(), SpringBodies{});
  const double step = of.motion.step();
  for (const SpringAxis& axis : axes) {
    // Central differences at nodes 0, 1, 2, 3, and the cubic through these at node -1.
    std::array<PolygonCorners, 4> rates;
    for (int node = 0; node < 4; ++node) {
      const double x = (node + 0.5) * step, h = step / 4;
      rates[static_cast<std::size_t>(node)] =
          (axis.seen_from_panel(of.motion, 0, x + h) - axis.seen_from_panel(of.motion, 0, x - h)) /
          (2 * h);
      const PolygonCorners found = axis.rates_from_panel(of.motion, 0, node);
      EXPECT_LT((rates[static_cast<std::size_t>(node)] - found).norm(), 0.01);
    }
    const PolygonCorners before = 4 * rates[0] - 6 * rates[1] + 4 * rates[2] - rates[3];
    // Rates of some 100 mm, differences of the fourth order: a share of step^4, 4e-7.
    EXPECT_LT((before - axis.rates_from_panel(of.motion, 0, -1)).norm(), 0.02);
  }
}

// Diagonals of a parallelogram halve each other, however it is folded: the closed form is 0.
TEST(SpringClearance, ParallelogramsHaveCrossingDiagonals) {
  const PerforatedSheet base = with_holes({1, 3, 8, 10});
  const Eigen::Matrix2Xd shifts_mm = member_of(base, 2, true, 4);
  const OwnSheet own(base, shifts_mm);
  const PanelMotion motion = resolved_motion(own.sheet).value();
  const auto outlines = trimmed_panels(own.sheet.panels(), own.sheet.vertices_mm(), 5);
  const double end_deg = 0.9 * motion.way().end_deg();
  std::vector<double> pilot_deg;
  for (int k = 0; k <= 12; ++k) pilot_deg.push_back(end_deg * k / 12);
  const auto study =
      spring_clearance(own.sheet, motion, outlines, {}, motion.way().x_of(end_deg), pilot_deg);
  for (const auto& apart : study->apart) EXPECT_LT(apart.largest_hole_mm, 1e-6);
  EXPECT_EQ(std::ranges::count_if(study->springs.touching,
                                  [&](const SpringMeeting& met) {
                                    const auto& diagonals = own.sheet.mechanism().diagonals;
                                    return diagonals[static_cast<std::size_t>(met.spring)].loop ==
                                           diagonals[static_cast<std::size_t>(met.other)].loop;
                                  }),
            static_cast<Index>(base.holes.size()));
}

// Two springs that end at one vertex of the flat sheet, at an angle of theta, have ends
// 2 e sin(theta/2) apart, e being what is left out (the closest points, if theta < 90 degrees or
// not: rays only part).
TEST(SpringClearance, SpringsOfOneVertexAreJudgedBehindTheirEnds) {
  const TestSheet sheet{6, 6};
  const SheetOfSprings of(sheet.base, table1_mm(sheet));
  const Mechanism& mechanism = of.own.sheet.mechanism();
  const double end_mm = 12;
  const auto axes =
      spring_axes(mechanism, of.own.sheet.panels(), of.motion.way(), {.end_mm = end_mm});
  int shared = 0;
  for (std::size_t d = 0; d < axes.size(); ++d) {
    for (std::size_t e = 0; e < d; ++e) {
      const Diagonal &one = mechanism.diagonals[d], &other = mechanism.diagonals[e];
      for (const auto& [at, far] : {std::pair(one.from, one.to), std::pair(one.to, one.from)}) {
        if (at != other.from && at != other.to) continue;
        const int far_other = at == other.from ? other.to : other.from;
        const Vector3d u = (of.flat_mm.col(far) - of.flat_mm.col(at)).normalized();
        const Vector3d v = (of.flat_mm.col(far_other) - of.flat_mm.col(at)).normalized();
        const double closed_mm = end_mm * (u - v).norm();
        SpringWalk walk(of.motion, axes[d], axes[e]);
        EXPECT_NEAR(walk.move_to(0), closed_mm, 1e-9);
        ++shared;
      }
    }
  }
  EXPECT_GE(shared, 4);
}

// All pairs that a sweep in steps of a tenth of a degree sees touching, and no other but those in
// the band: the walk's bound holds between samples.
TEST(SpringClearance, ASweepSeesTheSamePairs) {
  TestSheet offset{4, 4};
  offset.base.springs = with_own(offset.base, {8, 2}, -3);
  const TestSheet plain{4, 4};
  for (const PerforatedSheet& base : {plain.base, offset.base}) {
    const SheetOfSprings of(base, some_shifts(plain, 0.4, 8));
    const SpringBodies bodies{.diameter_mm = 6};
    const double end_deg = 150;
    const SpringClearance study = of.study(bodies, end_deg, {});
    const auto axes =
        spring_axes(of.own.sheet.mechanism(), of.own.sheet.panels(), of.motion.way(), bodies);
    const auto expect_same = [&](SpringWalk walk, double limit_mm, const SpringMeetings& met,
                                 const auto& is_pair) {
      double least_mm = 1e300;
      for (int k = 0; k <= 1500; ++k) {
        least_mm = std::min(least_mm, walk.move_to(of.motion.way().x_of(end_deg * k / 1500)));
      }
      const auto found = std::ranges::find_if(met.touching, is_pair);
      if (least_mm < limit_mm) {
        EXPECT_NE(found, met.touching.end());
      }
      if (least_mm > limit_mm + kSpringTouch_mm + 1e-3) {
        EXPECT_EQ(found, met.touching.end());
      }
      // Bodies move by up to 0.2 mm in a tenth of a degree, next to the least distance far less.
      if (found != met.touching.end()) {
        EXPECT_NEAR(found->apart_mm, least_mm, kSpringTouch_mm + 0.02);
      }
      EXPECT_GT(least_mm, met.closest->clear_mm + limit_mm - kSpringTouch_mm - 1e-6);
    };
    for (std::size_t d = 0; d < axes.size(); ++d) {
      for (std::size_t e = 0; e < d; ++e) {
        expect_same(SpringWalk(of.motion, axes[e], axes[d]), bodies.diameter_mm, study.springs,
                    [&](const SpringMeeting& met) {
                      return met.spring == axes[e].diagonal && met.other == axes[d].diagonal;
                    });
      }
      for (std::size_t panel = 0; panel < of.outlines.size(); ++panel) {
        const int number = static_cast<int>(panel);
        expect_same(SpringWalk(of.motion, axes[d], number, of.outlines[panel]),
                    (bodies.diameter_mm + bodies.panel_mm) / 2, study.panels,
                    [&](const SpringMeeting& met) {
                      return met.spring == axes[d].diagonal && met.panel == number;
                    });
      }
    }
  }
}

// No two springs touch once one of each two that cross is left out.
TEST(SpringClearance, OneSpringInEachHoleMeetsNoOther) {
  const TestSheet sheet{6, 6};
  const OwnSheet own(sheet.base, table1_mm(sheet));
  const auto pairs = *touching_springs(own.sheet, {}, 140);
  const auto& diagonals = own.sheet.mechanism().diagonals;
  EXPECT_EQ(pairs.size(), sheet.base.holes.size());
  SpringBodies single;
  Springs springs;
  for (const auto& [spring, other] : pairs) {
    const Diagonal& diagonal = diagonals[static_cast<std::size_t>(other)];
    EXPECT_EQ(diagonal.loop, diagonals[static_cast<std::size_t>(spring)].loop);
    springs.single.push_back({diagonal.from, diagonal.to, 0, {}});
  }
  single.fill = springs;
  const PanelMotion motion = resolved_motion(own.sheet).value();
  const auto axes = spring_axes(own.sheet.mechanism(), own.sheet.panels(), motion.way(), single);
  EXPECT_EQ(axes.size(), sheet.base.holes.size());
  const SpringMeetings met = springs_that_meet(motion, axes, single, motion.way().x_of(140));
  EXPECT_TRUE(met.touching.empty());
  EXPECT_GT(met.closest->clear_mm, 0);
}

}  // namespace
}  // namespace misalign::solver
