// Faces and layers of springs against all assignments, by distances of vertex coordinates at angles
// one by one.
#include "solver/contact/spring_faces.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "solver/contact/contact.hpp"
#include "solver/contact/plate_thickness.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

using Eigen::Vector3d;
using Capsule = std::array<Vector3d, 2>;

constexpr double kUsed_deg = 100;
constexpr int kAngles = 50;

OwnSheet table1_sheet() {
  const TestSheet sheet{6, 6};
  return OwnSheet(sheet.base, sheet.shifted(golden("table1_odd.json")["displacements_mm"]) -
                                  sheet.base.sheet.vertices_mm);
}

SpringBodies bodies_on(const Mechanism& mechanism, const std::vector<int>& diagonals,
                       double diameter_mm, double panel_mm) {
  Springs springs;
  for (int d = 0; d < mechanism.diagonal_count(); ++d) {
    const Diagonal& diagonal = mechanism.diagonals[static_cast<std::size_t>(d)];
    springs.single.push_back(
        {{diagonal.from, diagonal.to}, std::ranges::count(diagonals, d) > 0 ? 1.0 : 0.0, {}});
  }
  return {diameter_mm, {}, panel_mm, springs};
}

// The folded vertex at one corner of a hole, raised along the normal of the panel that carries it.
Vector3d raised_corner(const OwnSheet& own, const Diagonal& diagonal, int corner,
                       const Eigen::Matrix3Xd& shape_mm, double height_mm) {
  const Mechanism& mechanism = own.sheet.mechanism();
  const Loop& loop = mechanism.loops[static_cast<std::size_t>(diagonal.loop)];
  const int facet = loop.carriers[static_cast<std::size_t>(corner)].facet;
  const std::array<int, 4>& v = own.model.base().sheet.facets[static_cast<std::size_t>(facet)];
  const auto arm = [&](const auto& of_mm, int k) {
    return (of_mm.col(v[static_cast<std::size_t>(k)]) - of_mm.col(v[0])).eval();
  };
  const Eigen::Matrix2Xd& flat_mm = own.sheet.vertices_mm();
  const Eigen::Vector2d next = arm(flat_mm, 1), last = arm(flat_mm, 3);
  const double side = next.x() * last.y() - next.y() * last.x() > 0 ? 1 : -1;
  const Vector3d up =
      side * Vector3d(arm(shape_mm, 1)).cross(Vector3d(arm(shape_mm, 3))).normalized();
  return shape_mm.col(loop.corners[static_cast<std::size_t>(corner)]) + height_mm * up;
}

// Axes of springs without their ends at all angles, by diagonal and height.
class Axes {
 public:
  Axes(const OwnSheet& own, const SpringBodies& bodies) : own_(own), bodies_(bodies) {
    for (int k = 1; k <= kAngles; ++k) {
      shapes_mm_.push_back(own.sheet.at(kUsed_deg * k / kAngles).vertices_mm);
    }
  }

  std::vector<Capsule> of(int d, double height_mm) const {
    const Diagonal& diagonal = own_.sheet.mechanism().diagonals[static_cast<std::size_t>(d)];
    const double flat_mm =
        (own_.sheet.point_mm(diagonal.from) - own_.sheet.point_mm(diagonal.to)).norm();
    const double share = bodies_.left_out_mm() / flat_mm;
    std::vector<Capsule> axes;
    for (const Eigen::Matrix3Xd& shape_mm : shapes_mm_) {
      const Vector3d from =
          raised_corner(own_, diagonal, diagonal.from_corner, shape_mm, height_mm);
      const Vector3d to = raised_corner(own_, diagonal, diagonal.to_corner, shape_mm, height_mm);
      axes.push_back({from + share * (to - from), to - share * (to - from)});
    }
    return axes;
  }

 private:
  const OwnSheet& own_;
  const SpringBodies& bodies_;
  std::vector<Eigen::Matrix3Xd> shapes_mm_;
};

double distance_mm(const Vector3d& point, const Capsule& axis) {
  const Vector3d along = axis[1] - axis[0];
  const double t = std::clamp((point - axis[0]).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (axis[0] + t * along - point).norm();
}

// The distance of two lines by the closest of many points of one, then of many near it.
double distance_mm(const Capsule& a, const Capsule& b) {
  double from = 0, to = 1, least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 3; ++round) {
    const double step = (to - from) / 20;
    double at = from;
    for (int k = 0; k <= 20; ++k) {
      const double t = from + k * step;
      const double apart_mm = distance_mm(a[0] + t * (a[1] - a[0]), b);
      if (apart_mm < least) least = apart_mm, at = t;
    }
    from = std::max(0.0, at - step), to = std::min(1.0, at + step);
  }
  return least;
}

double least_apart_mm(const std::vector<Capsule>& a, const std::vector<Capsule>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < a.size(); ++k) least = std::min(least, distance_mm(a[k], b[k]));
  return least;
}

bool have_common_vertex(const Mechanism& mechanism, int a, int b) {
  const Diagonal &one = mechanism.diagonals[static_cast<std::size_t>(a)],
                 &other = mechanism.diagonals[static_cast<std::size_t>(b)];
  for (const int vertex : {one.from, one.to}) {
    if (vertex == other.from || vertex == other.to) return true;
  }
  return false;
}

double height_of(const SpringBodies& bodies, int slot) {
  const double on_face = bodies.panel_mm / 2 + kLayerGap_mm + bodies.diameter_mm / 2;
  const double height =
      slot / 2 == 0 ? 0 : on_face + (slot / 2 - 1) * (bodies.diameter_mm + kLayerGap_mm);
  return slot % 2 == 0 ? height : -height;
}

// The trimmed panels, folded: their flat points by the coordinates of three corners.
std::vector<std::vector<Vector3d>> folded_panels(const OwnSheet& own,
                                                 const Eigen::Matrix3Xd& shape_mm) {
  const Eigen::Matrix2Xd& flat_mm = own.sheet.vertices_mm();
  const double trim_mm = kTrimPart * own.sheet.mechanism().panel_width_mm;
  const auto outlines = trimmed_panels(own.sheet.panels(), flat_mm, trim_mm);
  std::vector<std::vector<Vector3d>> panels;
  for (std::size_t panel = 0; panel < outlines.size(); ++panel) {
    const std::array<int, 4>& corners = own.sheet.panels().corners[panel];
    const auto arm = [&](const auto& of_mm, std::size_t k) {
      return (of_mm.col(corners[k]) - of_mm.col(corners[0])).eval();
    };
    Eigen::Matrix2d flat;
    flat << arm(flat_mm, 1), arm(flat_mm, 3);
    panels.emplace_back();
    for (Eigen::Index k = 0; k < outlines[panel].cols(); ++k) {
      const Eigen::Vector2d point = outlines[panel].col(k).head<2>();
      const Eigen::Vector2d parts = flat.inverse() * (point - flat_mm.col(corners[0]));
      panels.back().push_back(shape_mm.col(corners[0]) + parts(0) * arm(shape_mm, 1) +
                              parts(1) * arm(shape_mm, 3));
    }
  }
  return panels;
}

double distance_mm(const Vector3d& point, const std::vector<Vector3d>& polygon) {
  Vector3d normal = Vector3d::Zero();
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    normal += (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]);
  }
  normal.normalize();
  bool is_inside = true;
  double to_edges_mm = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector3d &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    is_inside = is_inside && normal.dot((to - from).cross(point - from)) >= 0;
    to_edges_mm = std::min(to_edges_mm, distance_mm(point, Capsule{from, to}));
  }
  return is_inside ? std::abs(normal.dot(point - polygon[0])) : to_edges_mm;
}

// The distance of a line from a plate: it is convex along the line, where thirds close in on it.
double distance_mm(const Capsule& axis, const std::vector<Vector3d>& polygon) {
  double from = 0, to = 1;
  const auto at = [&](double t) { return distance_mm(axis[0] + t * (axis[1] - axis[0]), polygon); };
  for (int k = 0; k < 30; ++k) {
    const double third = (to - from) / 3;
    if (at(from + third) < at(to - third)) {
      to -= third;
    } else {
      from += third;
    }
  }
  return at((from + to) / 2);
}

bool is_clear_of_panels(const OwnSheet& own, const std::vector<Capsule>& axes, double limit_mm) {
  for (int k = 1; k <= kAngles; ++k) {
    const Capsule& axis = axes[static_cast<std::size_t>(k) - 1];
    for (const auto& panel :
         folded_panels(own, own.sheet.at(kUsed_deg * k / kAngles).vertices_mm)) {
      if (distance_mm(axis, panel) < limit_mm) return false;
    }
  }
  return true;
}

// The least sum of layers of all assignments whose bodies stay `spare_mm` apart; -1 if there is
// none.
int least_layers(const OwnSheet& own, const SpringBodies& bodies, const std::vector<int>& diagonals,
                 double spare_mm) {
  const Axes axes(own, bodies);
  std::vector<std::vector<std::vector<Capsule>>> lines;
  for (const int d : diagonals) {
    lines.emplace_back();
    for (int slot = 0; slot < 6; ++slot)
      lines.back().push_back(axes.of(d, height_of(bodies, slot)));
  }
  const std::size_t count = diagonals.size();
  std::vector<bool> may_have(6 * count);
  for (std::size_t a = 0; a < 6 * count; ++a) {
    may_have[a] = is_clear_of_panels(own, lines[a / 6][a % 6],
                                     (bodies.diameter_mm + bodies.panel_mm) / 2 + spare_mm);
  }
  std::vector<std::vector<bool>> is_free(6 * count, std::vector<bool>(6 * count));
  for (std::size_t a = 0; a < 6 * count; ++a) {
    for (std::size_t b = 0; b < 6 * count; ++b) {
      const bool common = a % 6 == b % 6 && have_common_vertex(own.sheet.mechanism(),
                                                               diagonals[a / 6], diagonals[b / 6]);
      is_free[a][b] = !common && least_apart_mm(lines[a / 6][a % 6], lines[b / 6][b % 6]) >=
                                     bodies.diameter_mm + spare_mm;
    }
  }
  int best = -1;
  std::size_t all = 1;
  for (std::size_t k = 0; k < count; ++k) all *= 6;
  for (std::size_t code = 0; code < all; ++code) {
    std::vector<std::size_t> slots;
    std::size_t left = code;
    for (std::size_t k = 0; k < count; ++k, left /= 6) slots.push_back(6 * k + left % 6);
    bool is_clear = true;
    int layers = 0;
    for (std::size_t k = 0; k < count && is_clear; ++k) {
      is_clear = may_have[slots[k]];
      layers += static_cast<int>(slots[k] % 6 / 2);
      for (std::size_t i = 0; i < k && is_clear; ++i) is_clear = is_free[slots[i]][slots[k]];
    }
    if (is_clear && (best < 0 || layers < best)) best = layers;
  }
  return best;
}

int layers_in(const SpringFaces& faces) {
  int layers = 0;
  for (const HungSpring& spring : faces.springs) layers += spring.layer;
  return faces.springs.empty() ? -1 : layers;
}

TEST(SpringFaces, AreRaisedLeastOfAllAssignments) {
  const OwnSheet own = table1_sheet();
  ASSERT_GE(own.sheet.deploys_from_deg(), kUsed_deg);
  int raised = 0;
  for (const std::vector<int>& diagonals :
       {std::vector{0, 1, 2, 3}, std::vector{0, 2, 4, 6}, std::vector{4, 5, 8, 9}}) {
    for (const double diameter_mm : {1.0, 3.0}) {
      const SpringBodies bodies = bodies_on(own.sheet.mechanism(), diagonals, diameter_mm, 1);
      const auto faces = spring_faces(own.sheet, bodies, kUsed_deg);
      ASSERT_TRUE(faces);
      EXPECT_TRUE(faces->is_proven);
      // Bodies this close touch, and angles between those of the search come a little closer.
      const int tight = least_layers(own, bodies, diagonals, kSpringTouch_mm + 0.1);
      const int loose = least_layers(own, bodies, diagonals, -0.01);
      const int found = layers_in(*faces);
      if (tight == loose) {
        EXPECT_EQ(found, tight) << diameter_mm;
      } else {
        EXPECT_TRUE(found == tight || found >= loose) << diameter_mm;
      }
      raised += found > 0;
    }
  }
  EXPECT_GE(raised, 2) << "diagonals of one hole cross";
}

// Thin springs of holes with both diagonals, where there are layers for them.
std::vector<SpringFaces> raised_faces(const OwnSheet& own) {
  std::vector<SpringFaces> raised;
  for (const std::vector<int>& diagonals :
       {std::vector{0, 1}, std::vector{0, 1, 2, 3}, std::vector{4, 5, 8, 9}, std::vector{12, 13}}) {
    const SpringBodies bodies = bodies_on(own.sheet.mechanism(), diagonals, 1, 1);
    const auto faces = spring_faces(own.sheet, bodies, kUsed_deg);
    EXPECT_TRUE(faces);
    if (faces && layers_in(*faces) > 0) raised.push_back(*faces);
  }
  EXPECT_FALSE(raised.empty());
  return raised;
}

// Nothing collides: springs by pairs, at every angle; and those that share a vertex have different
// faces or layers.
TEST(SpringFaces, CollideNowhere) {
  const OwnSheet own = table1_sheet();
  std::vector<int> all;
  for (int d = 0; d < own.sheet.mechanism().diagonal_count(); ++d) all.push_back(d);
  std::vector<int> first;
  for (int d = 0; d < own.sheet.mechanism().diagonal_count(); d += 2) first.push_back(d);
  int assigned = 0;
  for (const auto& diagonals : {all, first}) {
    const SpringBodies bodies = bodies_on(own.sheet.mechanism(), diagonals, 2, 1);
    const auto faces = spring_faces(own.sheet, bodies, kUsed_deg);
    ASSERT_TRUE(faces);
    if (faces->springs.empty()) continue;
    ++assigned;
    ASSERT_EQ(faces->springs.size(), diagonals.size());
    const Axes axes(own, bodies);
    double closest_mm = std::numeric_limits<double>::infinity();
    for (const HungSpring& spring : faces->springs) {
      EXPECT_EQ(spring.height_mm >= 0, spring.face == SheetFace::above || spring.layer == 0);
      for (const HungSpring& other : faces->springs) {
        if (other.diagonal >= spring.diagonal) continue;
        const double apart_mm = least_apart_mm(axes.of(spring.diagonal, spring.height_mm),
                                               axes.of(other.diagonal, other.height_mm));
        closest_mm = std::min(closest_mm, apart_mm - bodies.diameter_mm);
        const bool is_alike = spring.face == other.face && spring.layer == other.layer;
        EXPECT_FALSE(is_alike &&
                     have_common_vertex(own.sheet.mechanism(), spring.diagonal, other.diagonal));
      }
    }
    EXPECT_GE(closest_mm, 0);
    ASSERT_TRUE(faces->closest);
    // The closest pair may be a spring and a panel; bodies are never closer than it.
    EXPECT_GE(closest_mm, faces->closest->clear_mm - kSpringTouch_mm - 1e-3);
  }
  EXPECT_GE(assigned, 1);
}

// The lower of two springs on one face hangs first, those below before all.
TEST(SpringFaces, HangFromTheLowestLayerUp) {
  const OwnSheet own = table1_sheet();
  for (const SpringFaces& faces : raised_faces(own)) {
    std::vector<int> turns;
    for (const HungSpring& spring : faces.springs) {
      turns.push_back(spring.turn);
      for (const HungSpring& other : faces.springs) {
        if (spring.face == other.face && spring.layer < other.layer) {
          EXPECT_LT(spring.turn, other.turn);
        }
        if (spring.face == SheetFace::below && other.face == SheetFace::above) {
          EXPECT_LT(spring.turn, other.turn);
        }
      }
    }
    std::ranges::sort(turns);
    for (std::size_t k = 0; k < turns.size(); ++k) EXPECT_EQ(turns[k], static_cast<int>(k));
  }
}

// Raised ends change lengths as coordinates say.
TEST(SpringFaces, SayHowHeightsChangeLengths) {
  const OwnSheet own = table1_sheet();
  for (const SpringFaces& faces : raised_faces(own)) {
    double largest_mm = 0;
    for (const HungSpring& spring : faces.springs) {
      const Diagonal& diagonal =
          own.sheet.mechanism().diagonals[static_cast<std::size_t>(spring.diagonal)];
      for (int k = 1; k <= kAngles; ++k) {
        const Eigen::Matrix3Xd& shape_mm = own.sheet.at(kUsed_deg * k / kAngles).vertices_mm;
        const auto length_mm = [&](double height_mm) {
          return (raised_corner(own, diagonal, diagonal.from_corner, shape_mm, height_mm) -
                  raised_corner(own, diagonal, diagonal.to_corner, shape_mm, height_mm))
              .norm();
        };
        largest_mm = std::max(largest_mm, std::abs(length_mm(spring.height_mm) - length_mm(0)));
      }
    }
    EXPECT_GT(largest_mm, 0);
    // Steps of two degrees and steps of the way end alike, where the change is largest.
    EXPECT_NEAR(faces.length_change_mm, largest_mm, 0.02 * largest_mm);
  }
}

}  // namespace
}  // namespace misalign::solver
