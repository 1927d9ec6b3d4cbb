// Joints with play: one hinge against a closed form, whole sheets against a solver whose unknowns
// are the panels, and what is left as the play vanishes.
#include <gtest/gtest.h>

#include <random>

#include "solver/play/backlash_follower.hpp"
#include "solver/sheet/sheet_filling.hpp"
#include "tests/solver/blocks.hpp"
#include "tests/solver/play/panel_poses.hpp"

namespace misalign::solver {
namespace {

constexpr double kWidth_mm = 80;

JointOffsets random_offsets(const Mechanism& mechanism, std::mt19937_64& random) {
  std::uniform_real_distribution<double> side(-1, 1);
  const auto point = [&] {
    Vec3<double> p{};
    do {
      p = {side(random), side(random), side(random)};
    } while (dot(p, p) > 1);
    return p;
  };
  JointOffsets offsets;
  for (std::size_t i = 0; i < mechanism.creases.size(); ++i) {
    offsets.creases_a.push_back(point());
    offsets.creases_b.push_back(point());
  }
  for (std::size_t i = 0; i < mechanism.balls.size(); ++i) offsets.balls.push_back(point());
  return offsets;
}

Eigen::Vector3d eigen(const Vec3<double>& v) { return {v.x, v.y, v.z}; }

// Two panels and one hinge. Whatever the angle, the second panel's own line lies on the first
// one's, its point a at the offset one; what is off the line goes round it on a circle, by the fold
// angle.
TEST(LooseHinge, TurnsAboutTheLineThroughItsOffsets) {
  std::mt19937_64 random(kSeed);
  const TestSheet sheet(4, 4);
  std::uniform_real_distribution<double> angle_deg(-179, 179);
  double worst = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const JointOffsets offsets = random_offsets(sheet.mechanism, random);
    const double scale = 0.05;  // panel widths: far beyond any play
    LooseSheet<double> loose;
    loosen(sheet.mechanism, sheet.geometry, offsets, scale, loose);
    for (int i = 0; i < static_cast<int>(sheet.mechanism.creases.size()); ++i) {
      const Crease& crease = sheet.mechanism.creases[i];
      const double rho_deg = angle_deg(random);
      const auto pose_at = [&](double deg) {
        FoldState<double> state = flat_state<double>(sheet.mechanism);
        state.creases[i] = half_angle_of_deg(deg);
        const Passage passage{false, i, 1, crease.a};
        Pose<double> pose = Pose<double>::identity();
        displace_before(loose, passage, pose);
        pose = pose.then_rotate(passage_rotation(sheet.mechanism, loose, state, passage),
                                flat_point(loose, passage.vertex));
        displace_after(loose, passage, pose);
        return pose;
      };
      const Eigen::Vector3d a = eigen(flat_point(loose, crease.a));
      const Eigen::Vector3d b = eigen(flat_point(loose, crease.b));
      const Eigen::Vector3d on_a = a + scale * eigen(offsets.creases_a[i]);
      const Eigen::Vector3d on_b = b + scale * eigen(offsets.creases_b[i]);
      const Eigen::Vector3d line = (on_b - on_a).normalized();
      const Pose<double> unfolded = pose_at(0), folded = pose_at(rho_deg);
      const auto off = [&](const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
        worst = std::max(worst, (x - y).norm());
      };
      off(eigen(folded * flat_point(loose, crease.a)), on_a);
      off(eigen(folded * flat_point(loose, crease.b)), on_a + (b - a).norm() * line);
      for (const Vec3<double> point : {Vec3<double>{1, 2, 0}, {0.3, -1, 0.5}}) {
        const Eigen::Vector3d arm = eigen(unfolded * point) - on_a;
        const double turn = -rho_deg * kRadPerDeg;  // Rodrigues
        off(eigen(folded * point), on_a + std::cos(turn) * arm + std::sin(turn) * line.cross(arm) +
                                       (1 - std::cos(turn)) * line.dot(arm) * line);
      }
      // The smallest rotation from one line to the other has its axis across both.
      const Eigen::Vector3d across = (b - a).cross(line);
      off(eigen(unfolded.rotation * Vec3<double>{across.x(), across.y(), across.z()}), across);
    }
  }
  EXPECT_LE(worst, 1e-14) << "seed " << kSeed;
}

// The other way round is the inverse.
TEST(LooseHinge, BackIsBack) {
  std::mt19937_64 random(kSeed);
  const TestSheet sheet(4, 4);
  LooseSheet<double> loose;
  loosen(sheet.mechanism, sheet.geometry, random_offsets(sheet.mechanism, random), 0.05, loose);
  const FoldState<double> state = sheet.folded(70);
  for (const Loop& loop : sheet.mechanism.loops) {
    Pose<double> pose = Pose<double>::identity();
    const auto pass = [&](const Passage& passage) {
      displace_before(loose, passage, pose);
      pose = pose.then_rotate(passage_rotation(sheet.mechanism, loose, state, passage),
                              flat_point(loose, passage.vertex));
      displace_after(loose, passage, pose);
    };
    for (const Passage& passage : loop.passages) pass(passage);
    for (auto passage = loop.passages.rbegin(); passage != loop.passages.rend(); ++passage) {
      pass({passage->ball, passage->joint, -passage->sense, passage->vertex});
    }
    EXPECT_LE(open_by(pose, 6), 1e-14);
  }
}

// A sheet that deploys, and its joints settled in some way.
struct Loose {
  Loose(int panels, const FlatVertices& vertices, double from_deg)
      : sheet(panels, panels), vertices_mm(vertices), model(sheet.base) {
    options.from_deg = from_deg;
    prepared = prepare_backlash(model, vertices_mm, options);
  }
  // The path of the sheet as designed down to the sample nearest to an angle.
  Eigen::Matrix3Xd shape_mm(double pilot_deg) const {
    SheetSolver solver(model);
    const Sheet folded(solver, vertices_mm - sheet.base.sheet.vertices_mm);
    return folded.shapes_mm()[static_cast<std::size_t>(pilot_deg) - 1];
  }
  std::vector<double> lengths_mm(const PanelPoses& poses) const {
    std::vector<double> lengths;
    for (const Loop& loop : sheet.mechanism.loops) {
      if (loop.hole < 0) continue;
      for (const double length : poses.diagonals_mm(loop.hole)) lengths.push_back(length);
    }
    return lengths;
  }
  // By the equations of loops and dense Newton, from the state that is given.
  std::vector<double> looped_mm(const LooseSheet<double>& loose, FoldState<double>& state,
                                double pilot_deg) const {
    state.creases[sheet.mechanism.pilot] = half_angle_of_deg(pilot_deg);
    ClosureSystem system(sheet.mechanism);
    DenseSolve solve(sheet.mechanism.equations);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(sheet.mechanism.unknowns);
    for (int i = 0; i < 8; ++i) {
      system.evaluate(loose, state);
      solve.factorize(system.jacobian().leftCols(sheet.mechanism.equations));
      step.head(sheet.mechanism.equations) = -solve.solve(system.residual());
      advance(sheet.mechanism, step.data(), state);
    }
    EXPECT_LE(system.evaluate(loose, state), 1e-12);
    std::vector<double> lengths(sheet.mechanism.diagonals.size());
    folded_lengths(sheet.mechanism, loose, state, lengths.data());
    for (double& length : lengths) length *= kWidth_mm;
    return lengths;
  }

  TestSheet sheet;
  FlatVertices vertices_mm;
  Model model;
  BacklashOptions options;
  BacklashStart prepared;
};

FlatVertices table1() {
  return TestSheet(6, 6).shifted(golden("table1_odd.json")["displacements_mm"]);
}

// A 4 x 4 sheet that deploys from 150 degrees or more: the first of some draws.
FlatVertices small_one() {
  const DrawableSheet sheets(4, 4);
  const ShiftBlock block = sheets.draws(20, kSeed);
  for (int i = 0; i < block.sheets; ++i) {
    const FlatVertices vertices_mm = sheets.vertices(block, i);
    if (sheets.history(vertices_mm).verdict.deploys_from_sample >= 150) return vertices_mm;
  }
  return {};
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, std::abs(a[k] - b[k]));
  return worst;
}

// Both closed: loops to 1e-12 panel widths over singular values from 1e-2 on at these angles,
// panels to 1e-10 mm.
TEST(LooseSheet, DiagonalsAreThoseOfPanelsThatAreJoined) {
  const Loose table(6, table1(), 5);
  std::mt19937_64 random(kSeed);
  double worst = 0;
  for (const double backlash_mm : {0.01, 0.5}) {
    const JointOffsets offsets = random_offsets(table.sheet.mechanism, random);
    LooseSheet<double> loose;
    loosen(table.sheet.mechanism, table.prepared.geometry, offsets, backlash_mm / kWidth_mm, loose);
    FoldState<double> state = table.prepared.start;
    PanelPoses poses(table.sheet.base, table.sheet.mechanism, table.vertices_mm, offsets,
                     backlash_mm);
    poses.start_from(table.shape_mm(table.prepared.start_deg));
    ASSERT_TRUE(poses.solve(table.prepared.start_deg));
    const auto looped = table.looped_mm(loose, state, table.prepared.start_deg);
    worst = std::max(worst, largest_difference(looped, table.lengths_mm(poses)));
  }
  RecordProperty("worst_mm", scientific(worst));
  EXPECT_LE(worst, 1e-10) << "seed " << kSeed;
}

// To first order in the offsets: halved with them, and halved again.
TEST(LooseSheet, TendsToTheSheetAsDesigned) {
  const Loose table(6, table1(), 5);
  std::mt19937_64 random(kSeed);
  const JointOffsets offsets = random_offsets(table.sheet.mechanism, random);
  std::vector<double> designed(table.sheet.mechanism.diagonals.size());
  folded_lengths(table.sheet.mechanism, table.prepared.geometry, table.prepared.start,
                 designed.data());
  for (double& length : designed) length *= kWidth_mm;
  double last = 0;
  for (const double backlash_mm : {0.04, 0.02, 0.01}) {
    LooseSheet<double> loose;
    loosen(table.sheet.mechanism, table.prepared.geometry, offsets, backlash_mm / kWidth_mm, loose);
    FoldState<double> state = table.prepared.start;
    const double off =
        largest_difference(table.looped_mm(loose, state, table.prepared.start_deg), designed);
    EXPECT_GT(off, 0.1 * backlash_mm);
    // What is of second order is a share of about 0.04 mm / 80 mm over a singular value.
    if (last > 0) {
      EXPECT_NEAR(off / last, 0.5, 0.01);
    }
    last = off;
  }
}

TEST(LooseSheet, SlopesAreThoseOfTheLengths) {
  const TestSheet sheet(6, 6);
  const Mechanism& mechanism = sheet.mechanism;
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  LooseSheet<double> loose;
  loosen(mechanism, sheet.geometry, random_offsets(mechanism, random), 0.05, loose);
  std::vector<double> rates(mechanism.unknowns), moves(rates), lengths(mechanism.diagonals.size()),
      slopes(lengths), misfit(mechanism.equations), before(lengths), after(lengths);
  for (double& rate : rates) rate = normal(random);
  const double h = 1e-5;
  const auto lengths_at = [&](double t, std::vector<double>& out) {
    FoldState<double> state = sheet.folded(60);
    for (std::size_t k = 0; k < rates.size(); ++k) moves[k] = t * rates[k];
    advance(mechanism, moves.data(), state);
    folded_lengths(mechanism, loose, state, out.data());
  };
  folded_lengths_and_slopes(mechanism, loose, sheet.folded(60), rates.data(), lengths.data(),
                            slopes.data(), misfit.data());
  lengths_at(-h, before);
  lengths_at(h, after);
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    EXPECT_NEAR(slopes[k], (after[k] - before[k]) / (2 * h), 1e-8) << "diagonal " << k;
  }
}

// The stretch that moves one way, degree by degree, and where the branch is lost, both from panels.
class OnPanels {
 public:
  OnPanels(const Loose& sheet, const JointOffsets& offsets, double backlash_mm)
      : sheet_(sheet),
        start_(sheet.sheet.base, sheet.sheet.mechanism, sheet.vertices_mm, offsets, backlash_mm) {
    start_.start_from(sheet.shape_mm(sheet.prepared.start_deg));
    EXPECT_TRUE(start_.solve(sheet.prepared.start_deg));
  }
  double one_way_to() const { return one_way(1, sheet_.prepared.to_deg); }
  double one_way_from() const { return one_way(-1, sheet_.options.from_deg); }

  // In steps that shrink where no solution follows, to a millionth of a degree; or where a crease
  // has gone over to the other side.
  double lost_deg() const {
    PanelPoses poses = start_;
    double at_deg = sheet_.prepared.start_deg, step_deg = 0.25;
    while (step_deg > 1e-6 && at_deg > 0) {
      PanelPoses next = poses;
      if (next.solve(at_deg - step_deg) && keeps_signs(next) && is_near(next, poses)) {
        poses = next;
        at_deg -= step_deg;
      } else {
        step_deg /= 2;
      }
    }
    return at_deg;
  }

 private:
  double one_way(int up, double end_deg) const {
    PanelPoses poses = start_;
    std::vector<double> last = sheet_.lengths_mm(poses);
    double at_deg = sheet_.prepared.start_deg;
    while (up * (end_deg - at_deg) > 0.5) {
      if (!poses.solve(at_deg + up) || !keeps_signs(poses)) break;
      const std::vector<double> lengths = sheet_.lengths_mm(poses);
      for (std::size_t k = 0; k < lengths.size(); ++k) {
        if (up * sheet_.prepared.directions[k] * (lengths[k] - last[k]) < 0) return at_deg;
      }
      last = lengths;
      at_deg += up;
    }
    return at_deg;
  }
  bool keeps_signs(const PanelPoses& poses) const {
    for (const Crease& crease : sheet_.sheet.mechanism.creases) {
      if (!(poses.sine(crease) * crease.assignment > 0)) return false;
    }
    return true;
  }
  // Not on another branch: near flat these are a few degrees away.
  bool is_near(const PanelPoses& poses, const PanelPoses& last) const {
    for (const Crease& crease : sheet_.sheet.mechanism.creases) {
      if (std::abs(poses.sine(crease) - last.sine(crease)) > 0.02) return false;
    }
    return true;
  }

  const Loose& sheet_;
  PanelPoses start_;
};

TEST(Backlash, StretchesAndLostBranchesAreThoseOfPanels) {
  const Loose small(4, small_one(), 5);
  BacklashFollower follower(small.model, small.prepared, small.options);
  std::mt19937_64 random(kSeed);
  int one_way = 0, turned = 0, crossed = 0;
  constexpr int kTrials = kFewer == 1 ? 8 : 2;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double backlash_mm = trial % 2 == 0 ? 0.01 : 0.1;
    const JointOffsets offsets = random_offsets(small.sheet.mechanism, random);
    const BacklashTrial judged = follower.trial(offsets, backlash_mm / kWidth_mm, false);
    const OnPanels panels(small, offsets, backlash_mm);
    ASSERT_TRUE(judged.is_known);
    if (judged.fault != Fault::fold_limit) {
      EXPECT_DOUBLE_EQ(judged.one_way_to_deg, panels.one_way_to()) << "trial " << trial;
    }
    EXPECT_DOUBLE_EQ(judged.one_way_from_deg, panels.one_way_from()) << "trial " << trial;
    // Turns are located to 1e-7 degrees; creases that go over, along a chord of 0.1 degrees.
    EXPECT_NEAR(judged.lost_deg, panels.lost_deg(),
                judged.lost == BacklashTrial::BranchEnd::turns ? 1e-5 : 5e-3)
        << "trial " << trial;
    EXPECT_GT(judged.gap_widths * kWidth_mm / backlash_mm, 0.1);
    EXPECT_LT(judged.gap_widths * kWidth_mm / backlash_mm, 8) << "two of each of four joints";
    one_way += judged.moves_one_way();
    turned += judged.lost == BacklashTrial::BranchEnd::turns;
    crossed += judged.lost == BacklashTrial::BranchEnd::other_branch;
    EXPECT_EQ(follower.trial(offsets, backlash_mm / kWidth_mm, true).moves_one_way(),
              judged.moves_one_way());
  }
  if (kFewer > 1) return;
  EXPECT_GT(one_way, 0);
  EXPECT_LT(one_way, kTrials);
  EXPECT_GT(turned, 0);
  EXPECT_GT(crossed, 0);
}

// Without play it is the sheet itself, all the way from D to flat.
TEST(Backlash, NoneIsNone) {
  for (const double from_deg : {5.0, 100.0}) {
    const Loose table(6, table1(), from_deg);
    EXPECT_EQ(table.prepared.to_sample, 156);
    BacklashFollower follower(table.model, table.prepared, table.options);
    std::mt19937_64 random(kSeed);
    const BacklashTrial trial =
        follower.trial(random_offsets(table.sheet.mechanism, random), 0, false);
    EXPECT_TRUE(trial.moves_one_way());
    EXPECT_DOUBLE_EQ(trial.one_way_to_deg, 156);
    EXPECT_DOUBLE_EQ(trial.one_way_from_deg, from_deg);
    EXPECT_LE(trial.lost_deg, 0.1);
    EXPECT_LE(trial.gap_widths, 1e-12);
  }
}

// Springs made for the sheet stop it, with play, where the diagonals of panels that are joined have
// the least energy: at the vertex of the parabola through energies a quarter of a degree apart. The
// follower's rates are differences over 2 deg: its error is the third derivative over the second
// times 1/6 deg^2, 0.011 deg.
TEST(Backlash, StopsAreThoseOfPanels) {
  constexpr double kRest_deg = 60, kApart_deg = 0.25;
  Loose table(6, table1(), 5);
  SheetSolver solver(table.model);
  const Sheet designed(solver, table.vertices_mm - table.sheet.base.sheet.vertices_mm);
  const Eigen::VectorXd free_mm = designed.at(kRest_deg).length_mm;
  table.prepared.filling = filling_on(*designed.way(), Springs{.rest_deg = kRest_deg});
  BacklashFollower follower(table.model, table.prepared, table.options);
  std::mt19937_64 random(kSeed);
  JointOffsets offsets = random_offsets(table.sheet.mechanism, random);
  EXPECT_NEAR(*follower.trial(offsets, 0, false).stop_deg, kRest_deg, 0.02);
  double most_deg = 0;
  for (int trial = 0; trial < 4; ++trial) {
    const auto found_deg = follower.trial(offsets, 0.05 / kWidth_mm, false).stop_deg;
    ASSERT_TRUE(found_deg);
    PanelPoses poses(table.sheet.base, table.sheet.mechanism, table.vertices_mm, offsets, 0.05);
    poses.start_from(table.shape_mm(table.prepared.start_deg));
    ASSERT_TRUE(poses.solve(table.prepared.start_deg));
    const auto energy_at = [&](double deg) {
      EXPECT_TRUE(poses.solve(deg));
      const std::vector<double> lengths_mm = table.lengths_mm(poses);
      return (Eigen::VectorXd::Map(lengths_mm.data(), free_mm.size()) - free_mm).squaredNorm();
    };
    for (double deg = table.prepared.start_deg; deg > *found_deg + 2; deg -= 1) energy_at(deg);
    const double above = energy_at(*found_deg + kApart_deg), at = energy_at(*found_deg),
                 below = energy_at(*found_deg - kApart_deg);
    EXPECT_NEAR(kApart_deg * (below - above) / (2 * (above + below - 2 * at)), 0, 0.02)
        << "trial " << trial;
    most_deg = std::max(most_deg, std::abs(*found_deg - kRest_deg));
    offsets = random_offsets(table.sheet.mechanism, random);
  }
  EXPECT_GT(most_deg, 0.1);  // play matters
}

// Near flat the loops are even in the angles and the tilts of the axes are not, so that the angle
// at which they lose the branch goes like the root of the play.
TEST(Backlash, LostAngleGoesLikeTheRootOfThePlay) {
  const Loose table(6, table1(), 5);
  BacklashFollower follower(table.model, table.prepared, table.options);
  std::mt19937_64 random(kSeed);
  const JointOffsets offsets = random_offsets(table.sheet.mechanism, random);
  double last_deg = 0;
  for (const double backlash_mm : {1e-4, 4e-4, 16e-4}) {
    const BacklashTrial trial = follower.trial(offsets, backlash_mm / kWidth_mm, false);
    ASSERT_EQ(trial.lost, BacklashTrial::BranchEnd::turns);
    if (last_deg > 0) {
      EXPECT_NEAR(trial.lost_deg / last_deg, 2, 0.05);
    }
    last_deg = trial.lost_deg;
  }
}

// Where Newton does not find the start at once the play grows; where there is none, or the play is
// beyond any measure, it says so and does not move one way.
TEST(Backlash, MuchPlayEndsIt) {
  const Loose table(6, table1(), 5);
  BacklashFollower follower(table.model, table.prepared, table.options);
  std::mt19937_64 random(kSeed);
  for (const double backlash_mm : {1.0, 5.0}) {
    const BacklashTrial trial = follower.trial(random_offsets(table.sheet.mechanism, random),
                                               backlash_mm / kWidth_mm, true);
    EXPECT_FALSE(trial.moves_one_way());
    EXPECT_GE(trial.one_way_from_deg, 5);
    EXPECT_LE(trial.one_way_to_deg, 156);
  }
}

}  // namespace
}  // namespace misalign::solver
