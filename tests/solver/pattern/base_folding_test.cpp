// The sequential method: closed forms, loops multiplied out, and sheets that it must refuse.
#include "solver/pattern/base_folding.hpp"

#include <Eigen/Geometry>
#include <random>

#include "schema/pattern/pattern_file.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

using Cause = NoBaseFolding::Cause;

// Every closed loop round a vertex: rotations about the creases that leave it, counter-clockwise by
// their directions, one after the other; the largest entry that is left of them.
double largest_opening(const CreasePattern& sheet, const std::vector<HalfAngle<double>>& angles) {
  std::vector<bool> inner(sheet.vertex_count(), true);
  for (const Edge& edge : sheet.edges) {
    if (edge.left < 0 || edge.right < 0) inner[edge.a] = inner[edge.b] = false;
  }
  double worst = 0;
  for (int v = 0; v < sheet.vertex_count(); ++v) {
    if (!inner[v]) continue;
    std::map<double, Eigen::Quaterniond> turns;  // by direction
    for (std::size_t e = 0; e < sheet.edges.size(); ++e) {
      const Edge& edge = sheet.edges[e];
      if (edge.a != v && edge.b != v) continue;
      const int to = edge.a == v ? edge.b : edge.a;
      const Eigen::Vector2d u = (sheet.vertices_mm.col(to) - sheet.vertices_mm.col(v)).normalized();
      turns[std::atan2(u.y(), u.x())] =
          Eigen::Quaterniond(angles[e].c, angles[e].s * u.x(), angles[e].s * u.y(), 0);
    }
    Eigen::Quaterniond around = Eigen::Quaterniond::Identity();
    for (const auto& [direction, turn] : turns) around = around * turn;
    const Eigen::Matrix3d left = around.toRotationMatrix() - Eigen::Matrix3d::Identity();
    worst = std::max(worst, left.cwiseAbs().maxCoeff());
  }
  return worst;
}

BaseFolding folded(const CreasePattern& sheet, const std::vector<int>& assignment, int pilot) {
  return std::get<BaseFolding>(fold_sequentially(sheet, assignment, pilot));
}

NoBaseFolding refused(const CreasePattern& sheet, const std::vector<int>& assignment) {
  auto result = fold_sequentially(sheet, assignment, default_pilot(sheet, {}));
  EXPECT_TRUE(std::holds_alternative<NoBaseFolding>(result));
  return std::get<NoBaseFolding>(result);
}

struct Miura {
  explicit Miura(int rows, int columns)
      : shape(MiuraShape::uniform(rows, columns, 80, 80, 40)),
        sheet(miura_sheet(shape)),
        assignment(miura_assignment(shape, sheet)) {}
  MiuraShape shape;
  CreasePattern sheet;
  std::vector<int> assignment;
};

// model.md: zigzag creases do rho_1, valley and mountain in turn; straight ones
// tan(|rho| / 2) = cos(alpha) tan(rho_1 / 2), each row with its own alpha in one zigzag's course.
TEST(BaseFolding, MiuraClosedForm) {
  const Miura paper(6, 6);
  const BaseFolding folding = folded(paper.sheet, paper.assignment, default_pilot(paper.sheet, {}));
  EXPECT_EQ(folding.assignment(), paper.assignment);
  EXPECT_EQ(folding.side(), 1);
  EXPECT_EQ(folding.end_deg(), 180);
  const double cos_alpha = 40 / std::hypot(40.0, 80.0);
  for (const double pilot_deg : {1e-6, 0.01, 1.0, 60.0, 120.0, 179.0, 179.9999}) {
    const auto angles = folding.fold_angles(half_angle_of_deg(pilot_deg));
    const double tangent = std::tan(pilot_deg * kRadPerDeg / 2);
    for (std::size_t e = 0; e < paper.sheet.edges.size(); ++e) {
      const Edge& edge = paper.sheet.edges[e];
      if (edge.on_perimeter()) continue;
      const int i = edge.a / 7, j = edge.a % 7;
      const bool zigzag = edge.b == edge.a + 7;
      const int line_sign = j % 2 == 1 ? 1 : -1;
      const int sign = zigzag ? line_sign : (j == 0 ? -1 : line_sign) * (i % 2 == 1 ? 1 : -1);
      const double size_deg = zigzag ? pilot_deg : 2 * std::atan(cos_alpha * tangent) / kRadPerDeg;
      EXPECT_NEAR(angle_deg(angles[e]), sign * size_deg, 1e-14 * pilot_deg)
          << line_label(edge.a, edge.b) << " at " << pilot_deg;
    }
  }
  for (const HalfAngle<double>& rho : folding.fold_angles({0, 1})) {
    EXPECT_TRUE(std::abs(rho.c) < 1e-15 || rho.s == 0);  // folded flat, or on the perimeter
  }
}

// A zigzag line's creases have sin(rho / 2) sin(alpha) in common, alpha = atan(height / offset) of
// their rows: where row 0, which has the pilot, has the least sine, it closes first; in the other
// order row 3 does, before the pilot is at 180 degrees.
TEST(BaseFolding, EndsAt180DegreesWhereItClosesThere) {
  std::vector<double> height_mm = {100, 30, 70, 45}, offset_mm = {60, 10, 33, 25}, sine;
  for (const bool closes : {true, false}) {
    sine.clear();
    for (int i = 0; i < 4; ++i)
      sine.push_back(height_mm[i] / std::hypot(height_mm[i], offset_mm[i]));
    const MiuraShape shape{{80, 80, 80, 80}, height_mm, offset_mm};
    const CreasePattern sheet = miura_sheet(shape);
    const BaseFolding folding =
        folded(sheet, miura_assignment(shape, sheet), default_pilot(sheet, {}));
    const double least = *std::min_element(sine.begin(), sine.end());
    if (closes) {
      EXPECT_EQ(folding.end_deg(), 180);
    } else {
      EXPECT_NEAR(folding.end_deg(), 2 * std::asin(least / sine[0]) / kRadPerDeg, 2e-7);
    }
    const auto angles = folding.fold_angles(half_angle_of_deg(folding.end_deg()));
    EXPECT_LT(largest_opening(sheet, angles), 1e-7);
    for (std::size_t e = 0; e < sheet.edges.size(); ++e) {
      const Edge& edge = sheet.edges[e];
      if (edge.on_perimeter() || edge.b != edge.a + 5) continue;
      const double pilot_sine = std::sin(folding.end_deg() * kRadPerDeg / 2);
      EXPECT_NEAR(std::abs(angles[e].s), pilot_sine * sine[0] / sine[edge.a / 5], 1e-12);
    }
    std::reverse(height_mm.begin(), height_mm.end());
    std::reverse(offset_mm.begin(), offset_mm.end());
  }
}

TEST(BaseFolding, ExampleMeshesCloseFromFlatToTheEnd) {
  struct Case {
    const char* file;
    double end_deg;  // 0: some end before 180
    double of_end;   // looked up to this part of it
    double opening;  // 4 to 10 times the worst seen
  };
  for (const Case& c :
       {Case{"angle-array-6x6", 180, 1, 1e-9},  // coordinates written to 1e-9 mm
        {"double-corrugation-6x6", 180, 1, 1e-14},
        // At the end angles go like a square root, and the errors of coordinates with them.
        {"turned-quads-6x6", 0, 1, 1e-5},
        {"turned-quads-6x6", 0, 0.999, 1e-9},
        {"miura-graded-6x6", 180, 1, 1e-14},
        {"miura-narrow-6x6", 180, 1, 1e-14},
        {"miura-wide-6x6", 180, 1, 1e-14}}) {
    const auto pattern = schema::read_pattern_file(
        std::string(MISALIGN_SOURCE_DIR "/search/patterns/") + c.file + ".json");
    const CreasePattern& sheet = pattern.base.sheet;
    const BaseFolding& folding = pattern.base.folding;
    const double end_deg = folding.end_deg();
    if (c.end_deg > 0) {
      EXPECT_EQ(end_deg, c.end_deg) << c.file;
    } else {
      EXPECT_GT(end_deg, 60) << c.file;
      EXPECT_LT(end_deg, 180) << c.file;
    }
    double worst = 0;
    std::vector<double> looked_at_deg = {0.01, 0.1, 1};
    for (int k = 1; k <= 60; ++k) looked_at_deg.push_back(end_deg * k / 60 * c.of_end);
    for (const double pilot_deg : looked_at_deg) {
      const auto angles = folding.fold_angles(half_angle_of_deg(pilot_deg));
      worst = std::max(worst, largest_opening(sheet, angles));
      for (std::size_t e = 0; e < sheet.edges.size(); ++e) {
        const int sign = angles[e].s > 0 ? 1 : angles[e].s < 0 ? -1 : 0;
        EXPECT_EQ(sign, folding.assignment()[e]) << c.file << " at " << pilot_deg;
      }
    }
    std::printf("%s: ends at %.7f deg, open by %.1e\n", c.file, end_deg, worst);
    EXPECT_LE(worst, c.opening) << c.file;
  }
}

// Any crease may be the pilot: the same folding, seen from the side where that crease is a valley.
TEST(BaseFolding, AnyPilotGivesTheSameFolding) {
  const Miura paper(5, 6);
  const BaseFolding usual = folded(paper.sheet, paper.assignment, default_pilot(paper.sheet, {}));
  const auto angles = usual.fold_angles(half_angle_of_deg(70));
  for (int e = 0; e < static_cast<int>(paper.sheet.edges.size()); ++e) {
    if (paper.sheet.edges[e].on_perimeter()) continue;
    const BaseFolding folding = folded(paper.sheet, paper.assignment, e);
    EXPECT_EQ(folding.side(), paper.assignment[e]);
    const auto same = folding.fold_angles({angles[e].c, std::abs(angles[e].s)});
    for (std::size_t k = 0; k < same.size(); ++k) {
      EXPECT_EQ(folding.assignment()[k], folding.side() * paper.assignment[k]);
      EXPECT_NEAR(same[k].s, folding.side() * angles[k].s, 1e-14);
    }
  }
}

// Letters that the edges of holes lack follow from the rest.
TEST(BaseFolding, UnknownAssignmentsAreCompleted) {
  for (const int side : {4, 6}) {
    const Miura miura(side, side);
    const std::vector<int> holes = checkerboard(miura.sheet, 1);
    std::vector<int> known = miura.assignment;
    for (std::size_t e = 0; e < known.size(); ++e) {
      const Edge& edge = miura.sheet.edges[e];
      for (const int f : holes) {
        if (edge.left == f || edge.right == f) known[e] = 0;
      }
    }
    const BaseFolding folding = folded(miura.sheet, known, default_pilot(miura.sheet, holes));
    EXPECT_EQ(folding.assignment(), miura.assignment);
  }
}

TEST(Refused, MountainsAndValleysThatDoNotFold) {
  const Miura one(2, 2);  // one inner vertex, A5
  const std::vector<int> creases = {find_edge(one.sheet, 1, 4), find_edge(one.sheet, 3, 4),
                                    find_edge(one.sheet, 4, 5), find_edge(one.sheet, 4, 7)};
  int refusals = 0;
  for (int letters = 0; letters < 16; ++letters) {
    auto assignment = one.assignment;
    int sum = 0;
    for (int k = 0; k < 4; ++k) {
      sum += assignment[creases[k]] = letters >> k & 1 ? 1 : -1;
    }
    // Three of a kind, and unlike them the crease A4-A5 between the two acute sectors.
    const bool folds = std::abs(sum) == 2 && assignment[creases[1]] * sum < 0;
    auto result = fold_sequentially(one.sheet, assignment, creases[0]);
    EXPECT_EQ(std::holds_alternative<BaseFolding>(result), folds) << letters;
    if (folds) continue;
    ++refusals;
    EXPECT_EQ(std::get<NoBaseFolding>(result).cause, Cause::assignment);
    EXPECT_EQ(std::get<NoBaseFolding>(result).vertex, 4);
  }
  EXPECT_EQ(refusals, 14);

  const Miura paper(6, 6);
  for (std::size_t e = 0; e < paper.sheet.edges.size(); ++e) {
    const Edge& edge = paper.sheet.edges[e];
    if (edge.on_perimeter()) continue;
    auto assignment = paper.assignment;
    assignment[e] *= -1;
    const NoBaseFolding none = refused(paper.sheet, assignment);
    EXPECT_EQ(none.cause, Cause::assignment);
    EXPECT_TRUE(none.vertex == edge.a || none.vertex == edge.b) << line_label(edge.a, edge.b);
  }
}

TEST(Refused, MeshesThatDoNotClose) {
  const Miura nine(3, 3);  // inner vertices A6, A7, A10, A11, one loop of four creases
  for (const int moved : {5, 6, 9, 10, 1, 4}) {
    CreasePattern sheet = nine.sheet;
    sheet.vertices_mm.col(moved) += Eigen::Vector2d(2, 3);
    const NoBaseFolding none = refused(sheet, nine.assignment);
    ASSERT_EQ(none.cause, Cause::open) << moved;
    const std::vector<int> loop = {5, 6, 9, 10};
    const Edge& edge = sheet.edges[none.edge];
    for (const int v : {edge.a, edge.b}) {
      EXPECT_TRUE(std::binary_search(loop.begin(), loop.end(), v)) << moved;
    }
    EXPECT_TRUE(none.vertex == edge.a || none.vertex == edge.b);
    EXPECT_GT(std::abs(none.angle_deg - none.other_angle_deg), kBaseClosure * none.pilot_deg);
  }
  // Within the tolerance, and ten times beyond it.
  for (const auto& [off_mm, closes] : {std::pair(1e-4, true), std::pair(1e-1, false)}) {
    CreasePattern sheet = nine.sheet;
    sheet.vertices_mm(1, 5) += off_mm;
    const auto result = fold_sequentially(sheet, nine.assignment, default_pilot(sheet, {}));
    EXPECT_EQ(std::holds_alternative<BaseFolding>(result), closes) << off_mm;
  }
}

TEST(Refused, AssignmentsWithSeveralCompletions) {
  Miura one(2, 2);
  one.sheet.vertices_mm.col(4) += Eigen::Vector2d(5, 7);  // no two creases are one line
  const int pilot = default_pilot(one.sheet, {});
  for (int& sign : one.assignment) sign = 0;
  one.assignment[pilot] = 1;
  const NoBaseFolding none = refused(one.sheet, one.assignment);
  EXPECT_EQ(none.cause, Cause::ambiguous);
  EXPECT_EQ(none.vertex, 4);
  const Edge& edge = one.sheet.edges[none.edge];
  EXPECT_TRUE(edge.a == 4 || edge.b == 4);
  EXPECT_NE(none.edge, pilot);
}

// Two blocks of four panels with one panel between them: its creases reach no inner vertex.
TEST(Refused, BlocksThatHangByAPanel) {
  const Miura whole(2, 5);
  CreasePattern sheet = whole.sheet;
  const int left_out = 1 * 5 + 2;  // row 1, column 2
  sheet.facets.erase(sheet.facets.begin() + left_out);
  sheet.places.erase(sheet.places.begin() + left_out);
  sheet.edges = edges_of(sheet.facets);
  std::vector<int> assignment;
  for (const Edge& edge : sheet.edges) {
    assignment.push_back(
        edge.on_perimeter() ? 0 : whole.assignment[find_edge(whole.sheet, edge.a, edge.b)]);
  }
  EXPECT_EQ(interior_vertices(sheet), (std::vector<int>{7, 10}));
  const NoBaseFolding none = refused(sheet, assignment);
  EXPECT_EQ(none.cause, Cause::unconnected);
  EXPECT_EQ(none.vertex, 10);
}

// The same sheet seen from below, mountains and valleys exchanged: the pilot is a mountain, the
// verdict is the same, and what is shown from +z has the other sign.
TEST(BaseFolding, PilotThatIsAMountain) {
  TestSheet above(6, 6), below(6, 6);
  std::vector<int> assignment = above.base.folding.assignment();
  for (int& sign : assignment) sign *= -1;
  below.base.folding = folded(below.base.sheet, assignment, above.base.folding.pilot_edge());
  below.mechanism = build_mechanism(below.base);
  EXPECT_EQ(above.base.folding.side(), 1);
  EXPECT_EQ(below.base.folding.side(), -1);
  EXPECT_EQ(below.base.folding.assignment(), above.base.folding.assignment());

  const FlatVertices vertices_mm = above.shifted(golden("table1_odd.json")["displacements_mm"]);
  const auto one = above.history(vertices_mm);
  const auto other = below.history(vertices_mm);
  EXPECT_EQ(one.verdict.deploys_from_sample, 156);
  EXPECT_EQ(other.verdict.deploys_from_sample, one.verdict.deploys_from_sample);
  EXPECT_EQ(other.verdict.first_fault, one.verdict.first_fault);
  EXPECT_EQ(other.length_mm, one.length_mm);
  EXPECT_EQ(other.fold_angle_deg, -one.fold_angle_deg);
  const auto at_90 = [](const TestSheet& sheet) {
    return FoldedShape(sheet.base.sheet, sheet.base.holes, sheet.mechanism)
        .vertices_mm(sheet.geometry, sheet.folded(90));
  };
  Eigen::Matrix3Xd mirrored = at_90(below);
  mirrored.row(2) *= -1;
  EXPECT_EQ(mirrored, at_90(above));
  EXPECT_GT(mirrored.row(2).cwiseAbs().maxCoeff(), 20);
}

}  // namespace
}  // namespace misalign::solver
