// Sheets with fewer holes than count to one degree of freedom, and others that fold by their base's
// angles: BasePath against followed paths, closed forms of the holes, and 50 digits.
#include "solver/model/base_path.hpp"

#include <Eigen/Geometry>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "solver/judging/base_judge.hpp"
#include "solver/lanes/batch.hpp"
#include "solver/records/record_sheet.hpp"
#include "solver/sheet/path_source.hpp"
#include "solver/sheet/sheet.hpp"
#include "tests/solver/few_holes.hpp"

namespace misalign::solver {
namespace {

const std::vector<std::vector<std::size_t>> kFewHoles = {
    {5}, {0, 15}, {0, 2, 9}, {1, 4, 11, 14}, {0, 2, 8, 10}};

// Where the system is square the same sheet can be followed by Newton's method.
TEST(BasePath, IsThePathThatNewtonFollows) {
  for (const char* holes : {"checkerboard-odd", "checkerboard-even"}) {
    const PerforatedSheet base = TestSheet(6, 6, holes).base;
    const Model model(base, {.end_deg = 179});
    const Eigen::Matrix2Xd shifts_mm = member_of(base, 4, false, 3);
    const FlatVertices vertices_mm = base.sheet.vertices_mm + shifts_mm;
    SheetGeometry<double> geometry;
    place(model.mechanism(), vertices_mm, geometry);
    BasePath path(model.mechanism(), base);
    PathPoint here(model.mechanism());
    double angle = 0, rate = 0, length = 0, slope = 0, singular = 0;
    std::vector<PathPoint> followed;
    const StationVisitor keep = [&](const Station&, const PathPoint& point) {
      followed.push_back(point);
    };
    const FoldingHistory history = record_history(model, vertices_mm, &keep);
    ASSERT_EQ(history.stations.size(), 179u);
    for (std::size_t k = 0; k < followed.size(); ++k) {
      path.find(geometry, history.stations[k].pilot, here);
      for (std::size_t c = 0; c < here.state.creases.size(); ++c) {
        const HalfAngle<double>&a = here.state.creases[c], &b = followed[k].state.creases[c];
        angle = std::max(angle, std::abs(a.s * b.c - a.c * b.s));
      }
      for (std::size_t u = 0; u < here.rates.size(); ++u) {
        rate = std::max(rate, std::abs(here.rates[u] - followed[k].rates[u]));
      }
      for (std::size_t d = 0; d < here.lengths.size(); ++d) {
        length = std::max(length, std::abs(here.lengths[d] - followed[k].lengths[d]));
        slope = std::max(slope, std::abs(here.slopes[d] - followed[k].slopes[d]));
      }
      EXPECT_LE(path.open_by(geometry, here.state), 1e-12);
      singular =
          std::max(singular, std::abs(path.singular_value() / history.singular_value_min[k] - 1));
    }
    // At 179 degrees the least singular value is some 1e-4, and Newton stops at 1e-12.
    EXPECT_LE(angle, 1e-9);
    EXPECT_LE(rate, 1e-6);
    EXPECT_LE(length, 1e-11);
    EXPECT_LE(slope, 1e-9);
    EXPECT_LE(singular, 1e-4);
  }
}

// More equations than unknowns hold, in one way only; lengths and reversals are those of the closed
// forms, which know nothing of loops.
TEST(BasePath, FoldsWithFewerHoles) {
  for (const std::vector<std::size_t>& holes : kFewHoles) {
    const PerforatedSheet base = with_holes(holes);
    const Model model(base);
    ASSERT_TRUE(model.is_overconstrained());
    const ParallelFamily family = family_with_rim(base);
    const double width_mm = model.mechanism().panel_width_mm;
    for (const unsigned seed : {1u, 2u, 3u}) {
      const Eigen::Matrix2Xd shifts_mm = member_of(base, 5, false, seed);
      const FoldingHistory history = record_on_base(model, base.sheet.vertices_mm + shifts_mm);
      ASSERT_EQ(history.stations.size(), 180u);
      EXPECT_LE(*std::ranges::max_element(history.open_by), 1e-12);
      EXPECT_LE(*std::ranges::max_element(history.isometry_error_mm), 1e-11 * width_mm);
      EXPECT_GE(*std::min_element(history.singular_value_min.begin(),
                                  history.singular_value_min.end() - 5),
                1e-4);
      const auto motions = family.motions(shifts_mm);
      const auto length_mm = [&](Eigen::Index d, double pilot_deg) {
        return motions[static_cast<std::size_t>(d / 2)].length_mm(static_cast<int>(d % 2),
                                                                  half_angle_of_deg(pilot_deg));
      };
      for (Eigen::Index d = 0; d < history.length_mm.cols(); ++d) {
        for (Eigen::Index row = 0; row < 180; ++row) {
          const double at_deg = static_cast<double>(row + 1);
          EXPECT_NEAR(history.length_mm(row, d), length_mm(d, at_deg), 1e-11 * width_mm);
          if (row == 179) continue;
          // Central differences of an even step: rounding 1e-12 mm over 2e-3 deg.
          const double slope = (length_mm(d, at_deg + 1e-3) - length_mm(d, at_deg - 1e-3)) / 2e-3;
          EXPECT_NEAR(history.slope_mm_per_deg(row, d), slope, 1e-7);
          const double by_formula = motions[static_cast<std::size_t>(d / 2)].slope_mm(
              static_cast<int>(d % 2), half_angle_of_deg(at_deg));
          EXPECT_NEAR(kRadPerDeg * by_formula, slope, 1e-7);
        }
      }
      // No diagonal turns before the reversal that is said, and one does there, by the path's
      // slopes.
      ASSERT_TRUE(history.extremes);
      const double turns_deg = history.extremes->reverses_deg.value_or(180);
      SheetGeometry<double> geometry;
      place(model.mechanism(), base.sheet.vertices_mm + shifts_mm, geometry);
      const BasePath path(model.mechanism(), base);
      const auto slopes_at = [&](double pilot_deg) {
        PathPoint point(model.mechanism());
        path.find(geometry, half_angle_of_deg(pilot_deg), point);
        return point.slopes;
      };
      const std::vector<double> first = slopes_at(0.5), before = slopes_at(turns_deg - 1e-5);
      const auto has_turned = [&](const std::vector<double>& slopes) {
        bool turned = false;
        for (std::size_t d = 0; d < first.size(); ++d) turned |= slopes[d] * first[d] < 0;
        return turned;
      };
      for (double at_deg = 1; at_deg < turns_deg; ++at_deg) {
        EXPECT_FALSE(has_turned(slopes_at(at_deg))) << at_deg;
      }
      EXPECT_FALSE(has_turned(before));
      EXPECT_EQ(has_turned(slopes_at(turns_deg + 1e-5)),
                history.extremes->reverses_deg.has_value());
    }
  }
}

// How far lengths along the path go on one way, in steps of this; and by how much they go back
// within the step after that.
struct GoesOn {
  int steps = 0;
  double back_mm = 0;
};
GoesOn goes_on(const PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm, double step_deg) {
  const Mechanism mechanism = build_mechanism(base);
  SheetGeometry<double> geometry;
  place(mechanism, base.sheet.vertices_mm + shifts_mm, geometry);
  const BasePath path(mechanism, base);
  PathPoint point(mechanism);
  GoesOn found;
  std::vector<double> last(mechanism.diagonals.size()), way(last.size());
  path.find(geometry, half_angle_of_deg(0), point);
  last = point.lengths;
  for (int k = 1; k * step_deg <= 180; ++k) {
    path.find(geometry, half_angle_of_deg(k * step_deg), point);
    for (std::size_t d = 0; d < last.size(); ++d) {
      const double step = point.lengths[d] - last[d];
      if (way[d] == 0 && std::abs(step) > 1e-12) way[d] = step > 0 ? 1 : -1;
      found.back_mm = std::max(found.back_mm, -step * way[d] * mechanism.panel_width_mm);
    }
    if (found.back_mm > 1e-10) return found;
    last = point.lengths;
    ++found.steps;
  }
  return found;
}

// By closed forms, against the folded sheet's coordinates: at the samples, and between them.
TEST(BaseJudge, SaysHowFarLengthsGoOnOneWay) {
  int monotone = 0, turned = 0, between = 0;
  for (const std::vector<std::size_t>& holes : kFewHoles) {
    const PerforatedSheet base = with_holes(holes);
    const Model at_samples(base, {.sample_deg = 10}),
        exact(base, {.sample_deg = 10}, {BumpRule::exact});
    BaseJudge judge(at_samples), exact_judge(exact);
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const Eigen::Matrix2Xd shifts_mm = member_of(base, 9, false, seed);
      const FlatVertices vertices_mm = base.sheet.vertices_mm + shifts_mm;
      const GoesOn coarse = goes_on(base, shifts_mm, 10), fine = goes_on(base, shifts_mm, 0.1);
      const Verdict verdict = judge.judge(vertices_mm);
      EXPECT_EQ(verdict.deploys_from_sample, coarse.steps) << seed;
      EXPECT_EQ(verdict.first_fault, coarse.steps == 18 ? Fault::none : Fault::not_monotone);
      const Verdict strict = exact_judge.judge(vertices_mm);
      // A turn within the last tenth before a sample may leave less than the band.
      if ((fine.steps + 1) % 100 != 0) {
        EXPECT_EQ(strict.deploys_from_sample, std::min(coarse.steps, fine.steps / 100)) << seed;
      }
      ++(coarse.steps == 18 ? monotone : turned);
      between += strict.first_fault == Fault::reverses_between || strict.first_fault == Fault::bump;
    }
  }
  EXPECT_GT(monotone, 10);
  EXPECT_GT(turned, 20);
  EXPECT_GT(between, 10);
}

// The same sheets as a block: what a campaign asks.
TEST(BaseJudge, IsWhatABatchSays) {
  const PerforatedSheet base = with_holes({0, 2, 9});
  const std::vector<int> all = all_vertices(base.sheet);
  const Model model(base, all, {}, 170);
  ShiftBlock block;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    Eigen::Matrix2Xd shifts_mm = member_of(base, 5, seed % 2 == 0, seed);
    if (seed == 30) shifts_mm(1, 16) += 1e-6;  // off the family
    block.shifts_mm.insert(block.shifts_mm.end(), shifts_mm.reshaped().begin(),
                           shifts_mm.reshaped().end());
    ++block.sheets;
  }
  for (const InstructionSet set : available_instruction_sets()) {
    const auto batch = make_batch(set, model);
    for (const Rejection& rejection : batch->reject(block)) EXPECT_EQ(rejection.fault, Fault::none);
    const std::vector<Verdict> verdicts = batch->judge(block);
    const std::vector<PathRecord>& records = batch->measure(block);
    for (int k = 0; k < block.sheets; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const Eigen::Matrix2Xd shifts_mm =
          Eigen::Map<const Eigen::Matrix2Xd>(block.of(k), 2, std::ssize(all));
      EXPECT_EQ(records[at].verdict.deploys_from_sample, verdicts[at].deploys_from_sample);
      if (k == 29) {
        EXPECT_EQ(verdicts[at].first_fault, Fault::undecided);
        EXPECT_EQ(verdicts[at].path_end, PathEnd::start_lost);
        continue;
      }
      EXPECT_EQ(verdicts[at].deploys_from_sample, goes_on(base, shifts_mm, 1).steps);
      const bool is_kept = verdicts[at].deploys_from_sample >= 170;
      EXPECT_EQ(records[at].lengths.size(),
                is_kept ? 6u * static_cast<std::size_t>(verdicts[at].deploys_from_sample) : 0u);
      EXPECT_LE(records[at].residual_max, 1e-12);
    }
  }
}

// Sheets of another program, which solved for vertices by Gauss and Newton at 50 angles: strains of
// the diagonals, most of them to six digits. Its straight creases run along y, and its pilot is one
// of those: they have cos(alpha) times the tangent of the zigzags' half angle.
TEST(BasePath, AgreesWithVerticesSolvedElsewhere) {
  for (const Json& sheet : golden("parallel_family.json")) {
    SCOPED_TRACE(sheet["name"].get<std::string>());
    const int rows = sheet["rows"], columns = sheet["columns"];
    std::vector<std::size_t> inner;
    for (const Json& hole : sheet["holes"]) {
      inner.push_back((hole[1].get<std::size_t>() - 1) * static_cast<std::size_t>(rows - 2) +
                      hole[0].get<std::size_t>() - 1);
    }
    std::ranges::sort(inner);
    const PerforatedSheet base = with_holes(inner, MiuraShape::uniform(columns, rows, 80, 80, 40));
    FlatVertices vertices_mm = base.sheet.vertices_mm;
    for (int column = 0; column <= columns; ++column) {
      for (int row = 0; row <= rows; ++row) {
        const Json& at = sheet["x_mm"][static_cast<std::size_t>(row * (columns + 1) + column)];
        vertices_mm.col(column * (rows + 1) + row) << at[1].get<double>(), at[0].get<double>();
      }
    }
    EXPECT_LE(parallel_misfit(base, vertices_mm - base.sheet.vertices_mm).mm, 1e-12);
    const Model model(base);
    SheetGeometry<double> geometry;
    place(model.mechanism(), vertices_mm, geometry);
    const BasePath path(model.mechanism(), base);
    PathPoint flat(model.mechanism()), point(model.mechanism());
    path.find(geometry, half_angle_of_deg(0), flat);
    const auto expect_strains = [&](double their_deg, std::vector<double> theirs, double within) {
      const HalfAngle<double> straight = half_angle_of_deg(their_deg);
      path.find(geometry, half_angle_of_ratio(std::sqrt(5.0) * straight.s, straight.c), point);
      std::vector<double> strains;
      for (std::size_t d = 0; d < point.lengths.size(); ++d) {
        strains.push_back(point.lengths[d] / flat.lengths[d] - 1);
      }
      ASSERT_EQ(strains.size(), theirs.size());
      std::ranges::sort(strains);
      std::ranges::sort(theirs);
      for (std::size_t d = 0; d < strains.size(); ++d) EXPECT_NEAR(strains[d], theirs[d], within);
    };
    // Angles to a thousandth of a degree, at slopes of 1e-3 a degree; strains to 1e-6.
    for (std::size_t k = 0; k < sheet["pilot_deg"].size(); ++k) {
      expect_strains(sheet["pilot_deg"][k], sheet["strain"][k], 1.1e-6);
    }
    expect_strains(179, sheet["strain_at_179_deg"], 1e-13);  // written in full
  }
}

// Off the family the spare equations do not hold: by about as much as the sheet is off.
TEST(BasePath, IsOpenOffTheFamily) {
  const PerforatedSheet base = with_holes({5});
  const Model model(base);
  Eigen::Matrix2Xd shifts_mm = member_of(base, 5, false, 1);
  shifts_mm(1, 16) += 0.08;
  const FoldingHistory history = record_on_base(model, base.sheet.vertices_mm + shifts_mm);
  EXPECT_GT(*std::ranges::max_element(history.open_by), 1e-4);
}

// The sheet as what studies ask: its way passes through the history's states.
TEST(BasePath, IsASheetsHistoryAndWay) {
  const PerforatedSheet base = with_holes({1, 4, 11, 14});
  const Model model(base);
  SheetSolver solver(model);
  const Sheet sheet(solver, member_of(base, 3, false, 5));
  const FoldingWay* const way = sheet.way();
  ASSERT_TRUE(way);
  EXPECT_EQ(way->end_deg(), 180);
  Eigen::VectorXd lengths_mm, rates;
  for (const Eigen::Index row : {9, 59, 119, 169}) {
    way->find_lengths(way->x_of(static_cast<double>(row + 1)), lengths_mm, rates);
    for (Eigen::Index d = 0; d < lengths_mm.size(); ++d) {
      EXPECT_NEAR(lengths_mm(d), sheet.history().length_mm(row, d), 1e-8);
    }
  }
  EXPECT_EQ(solver.paths().followed().closely + solver.paths().followed().as_functions, 0);
}

using Digits50 = boost::multiprecision::cpp_bin_float_50;
using Vector50 = Eigen::Matrix<Digits50, 3, 1>;
using Matrix50 = Eigen::Matrix<Digits50, 3, 3>;

Vector50 vertex_50(const CreasePattern& sheet, const Eigen::Matrix2Xd& shifts_mm, int v) {
  const Eigen::Vector2d base = sheet.vertices_mm.col(v), shift = shifts_mm.col(v);
  return {Digits50(base.x()) + Digits50(shift.x()), Digits50(base.y()) + Digits50(shift.y()), 0};
}

// About the line through two points, by Rodrigues' formula.
Matrix50 turned(const Vector50& along, const Digits50& tangent_of_half) {
  const Digits50 t2 = tangent_of_half * tangent_of_half, scale = 1 / (1 + t2);
  const Vector50 u = along / sqrt(along.dot(along));
  Matrix50 cross;
  cross << 0, -u.z(), u.y(), u.z(), 0, -u.x(), -u.y(), u.x(), 0;
  const Digits50 sine = 2 * tangent_of_half * scale, cosine = (1 - t2) * scale;
  const Matrix50 spin = sine * cross, square = (1 - cosine) * (cross * cross);
  return Matrix50::Identity() + spin + square;
}

// Kept panels laid one after another across their creases; the most that a corner lies apart from
// where another panel has it, mm. Fold angles are the Miura-ori's: |tan(rho / 2)| is t across the
// creases of the zigzags and t cos(alpha) across the straight ones.
Digits50 torn_mm(const PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm,
                 const Digits50& t) {
  const CreasePattern& sheet = base.sheet;
  const auto is_hole = [&](int f) { return std::ranges::count(base.holes, f) > 0; };
  const Digits50 cosine = 1 / sqrt(Digits50(5));  // of the sector angle: 40 along, 80 across
  std::vector<std::optional<std::pair<Matrix50, Vector50>>> pose(sheet.facets.size());
  std::vector<int> waiting = {0};
  pose[0] = {Matrix50::Identity(), Vector50::Zero()};
  while (!waiting.empty()) {
    const int from = waiting.back();
    waiting.pop_back();
    for (std::size_t e = 0; e < sheet.edges.size(); ++e) {
      const Edge& edge = sheet.edges[e];
      if (edge.on_perimeter() || (edge.left != from && edge.right != from)) continue;
      const int to = edge.left == from ? edge.right : edge.left;
      if (is_hole(to) || pose[static_cast<std::size_t>(to)]) continue;
      const Vector50 a = vertex_50(sheet, shifts_mm, edge.a),
                     b = vertex_50(sheet, shifts_mm, edge.b);
      // Of the base: a member's creases are parallel to them.
      const bool is_straight = sheet.vertices_mm(1, edge.a) == sheet.vertices_mm(1, edge.b);
      const int sign = base.folding.assignment()[e] * (edge.left == from ? -1 : 1);
      const Matrix50 turn = turned(b - a, sign * (is_straight ? Digits50(t * cosine) : t));
      const auto& [rotation, shift] = *pose[static_cast<std::size_t>(from)];
      const Matrix50 next = rotation * turn;
      pose[static_cast<std::size_t>(to)] = {next, Vector50(rotation * a + shift - next * a)};
      waiting.push_back(to);
    }
  }
  Digits50 most = 0;
  std::vector<std::optional<Vector50>> at(static_cast<std::size_t>(sheet.vertex_count()));
  for (std::size_t f = 0; f < sheet.facets.size(); ++f) {
    if (is_hole(static_cast<int>(f))) continue;
    for (const int v : sheet.facets[f]) {
      const Vector50 here = pose[f]->first * vertex_50(sheet, shifts_mm, v) + pose[f]->second;
      auto& seen = at[static_cast<std::size_t>(v)];
      if (!seen) seen = here;
      for (int k = 0; k < 3; ++k) most = std::max<Digits50>(most, abs(here(k) - (*seen)(k)));
    }
  }
  return most;
}

// Members with whole millimetres, so that they are exact: delta moves vertices along x by whole
// numbers of itself, epsilon along the zigzag, (1, 2) / sqrt(5).
TEST(BasePath, ClosesInFiftyDigits) {
  for (const std::vector<std::size_t>& holes : kFewHoles) {
    const PerforatedSheet base = with_holes(holes);
    const ParallelFamily family = family_with_rim(base);
    Eigen::VectorXd coordinates = Eigen::VectorXd::Zero(family.dimension());
    for (int k = 0; k < family.dimension(); ++k) {
      using Kind = ParallelCoordinate::Kind;
      const auto& coordinate = family.coordinates()[static_cast<std::size_t>(k)];
      if (coordinate.kind == Kind::delta) coordinates(k) = 3;
      if (coordinate.kind == Kind::epsilon) coordinates(k) = 2 * std::sqrt(5.0);
    }
    Eigen::Matrix2Xd shifts_mm = family.shifts_mm(coordinates);
    EXPECT_LE((shifts_mm.array() - shifts_mm.array().round()).abs().maxCoeff(), 1e-12);
    shifts_mm = shifts_mm.array().round();
    EXPECT_GT(shifts_mm.cwiseAbs().maxCoeff(), 1);
    for (const double t : {0.02, 0.5, 1.0, 7.0, 1000.0}) {
      EXPECT_LE(torn_mm(base, shifts_mm, Digits50(t)), Digits50("1e-44")) << t;
      Eigen::Matrix2Xd off_mm = shifts_mm;
      off_mm(1, 16) += 1e-9;  // as far as no residual in doubles can tell from rounding
      if (t < 0.1) continue;  // next to flat it tears by its square
      EXPECT_GT(torn_mm(base, off_mm, Digits50(t)), Digits50("1e-11")) << t;
    }
  }
}

}  // namespace
}  // namespace misalign::solver
