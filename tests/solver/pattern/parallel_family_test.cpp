#include "solver/pattern/parallel_family.hpp"

#include <Eigen/SVD>

#include "solver/kinematics/diagonals.hpp"
#include "tests/solver/families.hpp"
#include "tests/solver/parallel_coordinates.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

ParallelFamily family_of(const PerforatedSheet& base, const std::vector<int>& vertices) {
  auto found = ParallelFamily::of(base, vertices);
  if (const auto* none = std::get_if<NoParallelFamily>(&found)) {
    throw std::runtime_error(none->why(base.sheet));
  }
  return std::get<ParallelFamily>(found);
}

// Of a member's coordinates, uniform, so that no vertex moves by more than `amplitude_mm`.
Eigen::Matrix2Xd random_member(const ParallelFamily& family, double amplitude_mm,
                               std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd coordinates(family.dimension());
  for (double& value : coordinates) value = uniform(random);
  const Eigen::Matrix2Xd shifts = family.shifts_mm(coordinates);
  return shifts * (amplitude_mm / shifts.cwiseAbs().maxCoeff());
}

// Conditions written down once more, as a matrix by finite differences of the folded base: what
// opens of the closures round holes and of the creases' directions when one shift is 1.
int nullity_by_folded_loops(const PerforatedSheet& base, const std::vector<int>& vertices) {
  const CreasePattern& sheet = base.sheet;
  const Mechanism mechanism = build_mechanism({sheet, base.holes, base.folding});
  const auto open = [&](const FlatVertices& vertices_mm) {
    std::vector<double> all;
    for (const Crease& crease : mechanism.creases) {
      const Eigen::Vector2d was = sheet.vertices_mm.col(crease.b) - sheet.vertices_mm.col(crease.a);
      const Eigen::Vector2d is = vertices_mm.col(crease.b) - vertices_mm.col(crease.a);
      all.push_back(was.x() * is.y() - was.y() * is.x());
    }
    for (const double pilot_deg : {37.0, 71.0, 111.0, 149.0}) {
      const FoldState<double> state =
          base_state(mechanism, base.folding, sheet.vertices_mm, half_angle_of_deg(pilot_deg));
      SheetGeometry<double> base_geometry, geometry;
      place(mechanism, sheet.vertices_mm, base_geometry);
      place(mechanism, vertices_mm, geometry);
      // Rotations are the base's: only the points that joints keep are others.
      geometry.axis_x = base_geometry.axis_x;
      geometry.axis_y = base_geometry.axis_y;
      for (const Loop& loop : mechanism.loops) {
        if (loop.hole < 0) continue;
        Pose<double> pose = Pose<double>::identity();
        for (const Passage& passage : loop.passages) {
          pose = pose.then_rotate(passage_rotation(mechanism, geometry, state, passage),
                                  flat_point(geometry, passage.vertex));
        }
        for (const double t : {pose.translation.x, pose.translation.y, pose.translation.z}) {
          all.push_back(t * mechanism.panel_width_mm * mechanism.panel_width_mm);
        }
      }
    }
    return all;
  };
  const std::vector<double> at_base = open(sheet.vertices_mm);
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(at_base.size()),
                         static_cast<Eigen::Index>(2 * vertices.size()));
  for (Eigen::Index c = 0; c < matrix.cols(); ++c) {
    FlatVertices moved = sheet.vertices_mm;
    moved(c % 2, vertices[static_cast<std::size_t>(c / 2)]) += 1;
    const std::vector<double> then = open(moved);
    for (std::size_t r = 0; r < then.size(); ++r) {
      matrix(static_cast<Eigen::Index>(r), c) = then[r] - at_base[r];
    }
  }
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues();
  const auto rank = (values.array() > 1e-7 * values(0)).count();
  return static_cast<int>(matrix.cols() - rank);
}

// The counts: 8 of 50 on the paper's sheet, 2 k with the rim free (and what only changes
// shapes of panels).
TEST(ParallelFamily, HasAsManyWaysAsFoldedLoopsLeave) {
  for (const auto& [rows, columns] : {std::pair(4, 4), std::pair(6, 6), std::pair(8, 6)}) {
    for (const char* holes : {"checkerboard-odd", "checkerboard-even"}) {
      const TestSheet sheet(rows, columns, holes);
      const auto interior = interior_vertices(sheet.base.sheet);
      const ParallelFamily held = family_of(sheet.base, interior);
      EXPECT_EQ(held.dimension(), nullity_by_folded_loops(sheet.base, interior)) << holes;
      auto most = all_vertices(sheet.base.sheet);
      const ParallelFamily open = family_of(sheet.base, most);
      most.erase(most.begin());
      EXPECT_EQ(open.dimension(), nullity_by_folded_loops(sheet.base, most)) << holes;
      const auto of_holes =
          std::count_if(open.coordinates().begin(), open.coordinates().end(),
                        [](const auto& c) { return c.kind != ParallelCoordinate::Kind::shape; });
      EXPECT_EQ(of_holes, 2 * static_cast<long>(sheet.base.holes.size()));
    }
  }
  const TestSheet paper(6, 6);
  EXPECT_EQ(family_of(paper.base, interior_vertices(paper.base.sheet)).dimension(), 8);
}

// Any base that has the family: members fold by the base's own fold angles, and their diagonals are
// as the formula says, at every degree to 180. Folded lengths come from poses along the loops.
void expect_closed_forms(const PerforatedSheet& base, double largest_mm, double tolerance) {
  const Mechanism mechanism = build_mechanism(base);
  std::mt19937 random(36);
  double worst_loop = 0, worst_length = 0;
  for (const bool rim : {false, true}) {
    const ParallelFamily family =
        family_of(base, rim ? all_vertices(base.sheet) : interior_vertices(base.sheet));
    if (family.dimension() == 0) continue;
    const Eigen::Matrix2Xd shifts = random_member(family, largest_mm, random);
    EXPECT_LE(parallel_misfit(base, shifts).mm, 1e-11);
    const Eigen::VectorXd coordinates = coordinates_of(family, shifts);
    EXPECT_LE((family.shifts_mm(coordinates) - shifts).cwiseAbs().maxCoeff(), 1e-10);
    const auto motions = family.motions(shifts);
    SheetGeometry<double> geometry;
    place(mechanism, base.sheet.vertices_mm + shifts, geometry);
    std::vector<double> lengths(mechanism.diagonals.size());
    for (int deg = 1; deg <= 180; ++deg) {
      const HalfAngle<double> pilot = half_angle_of_deg(deg);
      const FoldState<double> state =
          base_state(mechanism, base.folding, base.sheet.vertices_mm, pilot);
      for (const Loop& loop : mechanism.loops) {
        Pose<double> pose = Pose<double>::identity();
        for (const Passage& passage : loop.passages) {
          pose = pose.then_rotate(passage_rotation(mechanism, geometry, state, passage),
                                  flat_point(geometry, passage.vertex));
        }
        if (loop.hole < 0) continue;
        for (const double t : {pose.translation.x, pose.translation.y, pose.translation.z}) {
          worst_loop = std::max(worst_loop, std::abs(t));
        }
      }
      folded_lengths(mechanism, geometry, state, lengths.data());
      for (std::size_t i = 0; i < lengths.size(); ++i) {
        const double by_formula = motions[i / 2].length_mm(static_cast<int>(i % 2), pilot);
        worst_length =
            std::max(worst_length, std::abs(by_formula / mechanism.panel_width_mm - lengths[i]));
      }
    }
  }
  testing::Test::RecordProperty("worst_loop_widths", scientific(worst_loop));
  testing::Test::RecordProperty("worst_length_widths", scientific(worst_length));
  EXPECT_LE(worst_loop, tolerance);
  EXPECT_LE(worst_length, tolerance);
}

TEST(ParallelFamily, FoldsByTheBasesAngles) {
  for (const char* holes : {"checkerboard-odd", "checkerboard-even"}) {
    expect_closed_forms(TestSheet(6, 6, holes).base, 6, 1e-11);
    expect_closed_forms(TestSheet(4, 8, holes).base, 6, 1e-11);
  }
}

TEST(ParallelFamily, FoldsGradedAndWideSheets) {
  for (const char* name :
       {"miura-wide-6x6", "miura-narrow-6x6", "miura-graded-6x6", "double-corrugation-6x6"}) {
    SCOPED_TRACE(name);
    const CarriedFamily carried{name};
    expect_closed_forms(carried.base, 0.03 * carried.base.sheet.panel_width_mm, 1e-11);
  }
}

// With fewer holes there are more equations than unknowns, and they hold all the same.
TEST(ParallelFamily, FoldsWithOneHole) {
  TestSheet sheet(6, 6);
  const CreasePattern& mesh = sheet.base.sheet;
  const auto inner = inner_facets(mesh);
  for (const std::vector<int>& holes :
       {std::vector<int>{inner[5]}, {inner[0], inner[15]}, {inner[0], inner[2], inner[9]}}) {
    PerforatedSheet base = sheet.base;
    base.holes = holes;
    const auto shape = MiuraShape::uniform(6, 6, 80, 80, 40);
    base.folding = std::get<BaseFolding>(
        fold_sequentially(mesh, miura_assignment(shape, mesh), default_pilot(mesh, holes)));
    expect_closed_forms(base, 5, 1e-11);
  }
}

// A quadratic without a root is without one: next to the closed form's, at ten thousand angles.
TEST(ParallelFamily, DirectionIsWhatItsHistoryDoes) {
  std::mt19937 random(7);
  int clear = 0, unclear = 0;
  for (const char* holes : {"checkerboard-odd", "checkerboard-even"}) {
    const TestSheet sheet(6, 6, holes);
    const ParallelFamily family = family_of(sheet.base, all_vertices(sheet.base.sheet));
    for (const double amplitude_mm : {0.4, 4.0, 12.0}) {
      for (int trial = 0; trial < 5; ++trial) {
        for (const HoleMotion& motion :
             family.motions(random_member(family, amplitude_mm, random))) {
          int up = 0, down = 0;
          double before = 0;
          for (int k = 1; k <= 1800; ++k) {
            const double now = motion.product_change_mm2(half_angle_of_deg(0.1 * k));
            ++(now < before ? down : up);
            before = now;
          }
          const int seen = up == 0 ? 1 : down == 0 ? -1 : 0;
          EXPECT_EQ(motion.direction(), seen) << up << " up, " << down << " down";
          ++(seen != 0 ? clear : unclear);
        }
      }
    }
  }
  EXPECT_GT(clear, 50);
  EXPECT_GT(unclear, 20);
}

// The example, exact in binary: +a along x, and -a.
Eigen::Matrix2Xd ternary_member(const CreasePattern& sheet, double a_mm) {
  Eigen::Matrix2Xd shifts = Eigen::Matrix2Xd::Zero(2, sheet.vertex_count());
  for (const int label : {16, 17, 18, 19, 23}) shifts(0, label - 1) = a_mm;
  for (const int label : {27, 31, 32, 33, 34}) shifts(0, label - 1) = -a_mm;
  return shifts;
}

TEST(ParallelFamily, HasThePapersOwnDraws) {
  const TestSheet sheet(6, 6, "checkerboard-even");
  const ParallelFamily family = family_of(sheet.base, interior_vertices(sheet.base.sheet));
  for (const double a_mm : {0.4, 4.0, 8.0}) {
    const Eigen::Matrix2Xd shifts = ternary_member(sheet.base.sheet, a_mm);
    EXPECT_EQ(parallel_misfit(sheet.base, shifts).mm, 0);
    EXPECT_LE((family.shifts_mm(coordinates_of(family, shifts)) - shifts).cwiseAbs().maxCoeff(),
              1e-14);
    for (const HoleMotion& motion : family.motions(shifts)) EXPECT_NE(motion.direction(), 0);
  }
  // A vertex beside them that leaves the family by as much as it is shifted.
  Eigen::Matrix2Xd off = ternary_member(sheet.base.sheet, 0.4);
  off(1, 15) += 0.01;
  EXPECT_NEAR(parallel_misfit(sheet.base, off).mm, 0.01, 1e-12);
}

// The basis decides shifts: a member's are the same bits wherever it is made. In the paper's sheet
// every entry is a whole number of halves times the slant 2 / sqrt(5) or so; the ones that matter
// are in closed form.
TEST(ParallelFamily, BasisIsTheClosedForm) {
  const TestSheet sheet(6, 6, "checkerboard-even");
  const ParallelFamily family = family_of(sheet.base, interior_vertices(sheet.base.sheet));
  using Kind = ParallelCoordinate::Kind;
  for (int k = 0; k < family.dimension(); ++k) {
    ASSERT_NE(family.coordinates()[static_cast<std::size_t>(k)].kind, Kind::shape);
    const auto& coordinate = family.coordinates()[static_cast<std::size_t>(k)];
    Eigen::VectorXd one = Eigen::VectorXd::Unit(family.dimension(), k);
    const Eigen::Matrix2Xd shifts = family.shifts_mm(one);
    for (const double shift : shifts.reshaped()) {
      // delta moves vertices along x by whole numbers, epsilon along the zigzag.
      const double unit = coordinate.kind == Kind::delta ? 1 : std::sqrt(0.2);
      EXPECT_NEAR(shift / unit, std::round(shift / unit), 1e-13);
    }
  }
}

// The table of bases in README.md: of those that the program carries these have the family.
TEST(ParallelFamily, SaysWhyABaseHasNone) {
  for (const std::string& name : carried_families()) {
    SCOPED_TRACE(name);
    const CarriedFamily carried{name};
    const auto found = ParallelFamily::of(carried.base, carried.shifted_vertices);
    const bool has_none = name == "turned-quads-6x6" || name == "angle-array-6x6";
    ASSERT_EQ(std::holds_alternative<NoParallelFamily>(found), has_none);
    if (!has_none) continue;
    const auto& none = std::get<NoParallelFamily>(found);
    EXPECT_EQ(none.cause, NoParallelFamily::Cause::no_parallelogram);
    // By the drawn coordinates alone.
    const auto& v = carried.base.sheet.facets[static_cast<std::size_t>(none.hole)];
    const FlatVertices& at = carried.base.sheet.vertices_mm;
    const Eigen::Vector2d open = at.col(v[0]) - at.col(v[1]) + at.col(v[2]) - at.col(v[3]);
    EXPECT_NEAR(none.off, open.cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_NE(none.why(carried.base.sheet).find("is no parallelogram"), std::string::npos);
  }
}

}  // namespace
}  // namespace misalign::solver
