// Springs that end beside the vertices, on the panel across them: lengths against coordinates of
// the folded panels, verdicts against the dense reference, the way through flat against the sheet
// with its springs on the other side.
#include "solver/pattern/spring_ends.hpp"

#include "solver/kinematics/diagonals.hpp"
#include "solver/motion/deploy.hpp"
#include "solver/motion/joint_forces.hpp"
#include "solver/reference/reference.hpp"
#include "solver/sheet/sheet.hpp"
#include "tests/solver/families.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/own_spring_ends.hpp"

namespace misalign::solver {
namespace {

using Eigen::Vector3d;

struct WithSprings : DrawableSheet {
  explicit WithSprings(const SpringEnds& springs, int rows = 6, int columns = 6)
      : DrawableSheet(rows, columns) {
    base.springs = springs;
    mechanism = build_mechanism(base);
  }
};

// The panel across the corner k of a hole; where there is none the one on the side before it.
std::array<int, 4> carrier(const PerforatedSheet& base, int hole, int k) {
  const std::array<int, 4>& corners = base.sheet.facets[hole];
  const int vertex = corners[k], before = corners[(k + 3) % 4];
  std::array<int, 4> beside{};
  for (int f = 0; f < base.sheet.facet_count(); ++f) {
    if (f == hole || std::ranges::binary_search(base.holes, f)) continue;
    const auto& facet = base.sheet.facets[f];
    const auto has = [&](int v) { return std::ranges::find(facet, v) != facet.end(); };
    if (!has(vertex)) continue;
    if (!has(before) && !has(corners[(k + 1) % 4])) return facet;
    if (has(before)) beside = facet;
  }
  return beside;
}

// Where a spring ends, by the folded corners of its panel alone.
Vector3d end_mm(const std::array<int, 4>& panel, int vertex, const Vector3d& place_mm,
                const Eigen::Matrix3Xd& shape_mm) {
  const auto k = std::ranges::find(panel, vertex) - panel.begin();
  const Vector3d at = shape_mm.col(vertex);
  const Vector3d after = (Vector3d(shape_mm.col(panel[(k + 1) % 4])) - at).normalized(),
                 before = (Vector3d(shape_mm.col(panel[(k + 3) % 4])) - at).normalized();
  const Vector3d up = after.cross(before).normalized(), along = (after + before).normalized();
  return at + place_mm.x() * along + place_mm.y() * up.cross(along) + place_mm.z() * up;
}

Vector3d end_mm(const PerforatedSheet& base, int hole, int corner,
                const Eigen::Matrix3Xd& shape_mm) {
  const SpringEnds& springs = base.springs;
  const int vertex = base.sheet.facets[hole][corner];
  for (const SpringEnds::Own& own : springs.own) {
    if (own.hole != hole || own.vertex != vertex) continue;
    return end_mm(base.sheet.facets[own.panel], vertex, own.place_mm, shape_mm);
  }
  return end_mm(carrier(base, hole, corner), vertex, {springs.inset_mm, 0, springs.offset_mm},
                shape_mm);
}

std::string shown(const SpringEnds& springs) {
  return std::to_string(springs.inset_mm) + " " + std::to_string(springs.offset_mm) + ", " +
         std::to_string(springs.own.size()) + " of their own";
}

const SpringEnds kEnds[] = {{6, 0}, {0.5, 0}, {6, 1.5}, {0, -0.05}, {3, 0.2}};

std::vector<SpringEnds> ends_of(const PerforatedSheet& base) {
  std::vector<SpringEnds> ends(std::begin(kEnds), std::end(kEnds));
  ends.push_back(with_own(base, {}, 0));
  ends.push_back(with_own(base, {6, 0}, 0.3));
  return ends;
}

void expect_lengths_of_coordinates(const PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm) {
  const Model model(base);
  SheetSolver solver(model);
  const Sheet sheet(solver, shifts_mm);
  const auto& history = sheet.history();
  ASSERT_GT(history.length_mm.rows(), 100);
  double worst_mm = 0;
  for (Eigen::Index row = 0; row < history.length_mm.rows(); row += 7) {
    const Eigen::Matrix3Xd& shape_mm = sheet.shapes_mm()[static_cast<std::size_t>(row)];
    for (int d = 0; d < sheet.mechanism().diagonal_count(); ++d) {
      const Diagonal& diagonal = sheet.mechanism().diagonals[d];
      const int hole = sheet.mechanism().loops[diagonal.loop].hole;
      const double length_mm = (end_mm(base, hole, diagonal.from_corner, shape_mm) -
                                end_mm(base, hole, diagonal.to_corner, shape_mm))
                                   .norm();
      worst_mm = std::max(worst_mm, std::abs(length_mm - history.length_mm(row, d)));
    }
  }
  EXPECT_LE(worst_mm, 1e-9);
}

TEST(SpringEnds, LengthsAreThoseOfFoldedCoordinates) {
  for (const std::string& name : carried_families()) {
    SCOPED_TRACE(name);
    const CarriedFamily family(name);
    PerforatedSheet base = family.base;
    const ShiftBlock block = family.draws(1, kSeed);
    for (const SpringEnds& springs : ends_of(base)) {
      base.springs = springs;
      expect_lengths_of_coordinates(base, family.vertices(block, 0) - base.sheet.vertices_mm);
    }
  }
}

// 1,400 sheets, of which bores drive most all the way and springs off the mid-plane few.
TEST(SpringEnds, VerdictsAreTheReferences) {
  std::set<int> deploy_from;
  for (const SpringEnds& springs : ends_of(DrawableSheet(6, 6).base)) {
    SCOPED_TRACE(shown(springs));
    const WithSprings sheets(springs);
    const ShiftBlock block = sheets.draws(200 / kFewer, kSeed);
    const PathPlan plan = sheets.plan();
    Reference reference(sheets.mechanism, plan);
    const Model model = sheets.with_threshold(150, {}, 0.4);
    const auto batch = make_batch(available_instruction_sets().back(), model);
    const std::vector<Rejection> rejections = batch->reject(block);
    const std::vector<Verdict> judged = batch->judge(block);
    for (int i = 0; i < block.sheets; ++i) {
      const Verdict verdict = reference.judge(sheets.vertices(block, i));
      EXPECT_EQ(decision(judged[i]), decision(verdict)) << i;
      const bool passes = rejections[i].fault == Fault::none;
      EXPECT_TRUE(passes || verdict.deploys_from_sample < 150) << i;
      deploy_from.insert(verdict.deploys_from_sample);
    }
  }
  EXPECT_GT(deploy_from.size(), 20u);
}

// Cubics between stations of a tenth of a degree see the same bumps.
TEST(SpringEnds, BumpsAreTheReferences) {
  for (const SpringEnds& springs :
       {kEnds[0], kEnds[1], with_own(DrawableSheet(4, 4).base, {}, 0)}) {
    SCOPED_TRACE(shown(springs));
    const WithSprings sheets(springs, 4, 4);
    const Criterion exact{.bumps = BumpRule::exact};
    const PathPlan plan = sheets.plan(reference_path({}, 0.1, exact.bumps));
    Reference reference(sheets.mechanism, plan, exact);
    const Model model(sheets.base, sheets.shifted_vertices, {}, 1, exact);
    const ShiftBlock block = sheets.draws(60 / kFewer, kSeed + 1);
    const auto judged = make_batch(available_instruction_sets().back(), model)->judge(block);
    for (int i = 0; i < block.sheets; ++i) {
      EXPECT_EQ(decision(judged[i]), decision(reference.judge(sheets.vertices(block, i)))) << i;
    }
  }
}

// Beyond flat lies the mirror image: what it sees of a spring above the sheet, the sheet itself
// sees of one below.
TEST(SpringEnds, WaysGoOnThroughFlat) {
  for (const SpringEnds& springs : ends_of(DrawableSheet(4, 4).base)) {
    SCOPED_TRACE(shown(springs));
    SpringEnds mirror = springs;
    mirror.offset_mm *= -1;
    for (SpringEnds::Own& own : mirror.own) own.place_mm.z() *= -1;
    const WithSprings above(springs, 4, 4), below(mirror, 4, 4);
    const ShiftBlock block = above.draws(1, kSeed);
    const FlatVertices vertices_mm = above.vertices(block, 0);
    const Model model_above(above.base), model_below(below.base);
    const FoldingWay way_above = way_of(model_above, vertices_mm).value(),
                     way_below = way_of(model_below, vertices_mm).value();
    const FoldingHistory history = record_history(model_above, vertices_mm);
    Eigen::VectorXd lengths, rates, mirrored, mirrored_rates;
    for (Eigen::Index row = 0; row < history.length_mm.rows(); row += 10) {
      const double x =
          way_above.x_of(model_above.path().stations[static_cast<std::size_t>(row)].pilot_deg);
      way_above.find_lengths(x, lengths, rates);
      EXPECT_LE((lengths - history.length_mm.row(row).transpose()).cwiseAbs().maxCoeff(), 1e-8);
      way_above.find_lengths(-x, lengths, rates);
      way_below.find_lengths(x, mirrored, mirrored_rates);
      EXPECT_LE((lengths - mirrored).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_LE((rates + mirrored_rates).cwiseAbs().maxCoeff(), 1e-7);
    }
  }
}

// The moment that holds the pilot is the springs' energy's slope only if each pulls where it ends,
// on the panel that carries it.
TEST(SpringEnds, JointForcesHoldWhatTheyPull) {
  for (const SpringEnds& springs :
       {kEnds[0], kEnds[2], kEnds[3], with_own(DrawableSheet(6, 6).base, {}, 0.3)}) {
    SCOPED_TRACE(shown(springs));
    const WithSprings sheets(springs);
    const Model model(sheets.base);
    const FoldingWay way = way_of(model, sheets.vertices(sheets.draws(1, kSeed), 0)).value();
    const EnergyModel deploying(way, model.shape(), sheets.base, {});
    Deployment run = deploy(deploying, {0.0}, {});
    for (std::size_t k = 0; k < 5; ++k) run.rows[k] = run.rows[1 + 11 * k];
    run.rows.resize(5);
    const JointForces forces =
        find_joint_forces(deploying, model.shape(), sheets.base, run, {.in_motion = false});
    for (std::size_t k = 0; k < run.rows.size(); ++k) {
      const double x = run.rows[k].x, moment = deploying.at(x).slope / way.pilot_rate(x);
      ASSERT_GT(std::abs(moment), 1e-3);
      EXPECT_NEAR(forces.holding_n_mm[k], -moment, 1e-6 * std::abs(moment)) << x;
    }
  }
}

}  // namespace
}  // namespace misalign::solver
