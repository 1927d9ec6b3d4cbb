// Bumps between samples: the cubic against one that is sampled finely, and against paths that are
// followed in steps of a hundredth of a degree.
#include "solver/verdict/between.hpp"

#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

// Any cubic over a parabola of the pilot is met exactly: least slope and way back against 20,000
// points of it.
TEST(LookBetween, AgreesWithTheCubicItself) {
  std::mt19937 words(kSeed);
  const auto random = [&] { return static_cast<double>(words()) / 2147483648.0 - 1; };
  int with_bump = 0, without = 0;
  for (int trial = 0; trial < 400; ++trial) {
    double k[4] = {random(), random(), random(), random()};
    for (int zero = 0; zero < 4; ++zero) {
      if (words() % 4 == 0) k[zero] = 0;  // lines and parabolas too
    }
    const double step = 0.01 + (random() + 1) * 0.2;
    const double bend = words() % 4 == 0 ? 0 : 0.8 * random();
    const auto pilot = [&](double x) { return x + bend * x * (x / step - 1); };
    const auto pilot_rate = [&](double x) { return 1 + bend * (2 * x / step - 1); };
    const auto length = [&](double x) { return ((k[3] * x + k[2]) * x + k[1]) * x + k[0]; };
    const auto slope = [&](double x) {
      return ((3 * k[3] * x + 2 * k[2]) * x + k[1]) / pilot_rate(x);
    };
    const int direction = words() % 2 ? 1 : -1;
    const BetweenSamples seen = look_between({length(0), slope(0)}, {length(step), slope(step)},
                                             step, pilot_rate(step) / pilot_rate(0), direction);
    constexpr int kPoints = 20000;
    double least = HUGE_VAL, back = 0, top = direction * length(0), from = -1;
    for (int i = 0; i <= kPoints; ++i) {
      const double x = step * i / kPoints, along = direction * length(x);
      least = std::min(least, direction * slope(x));
      if (along < top - 1e-12 && from < 0) from = pilot(x) / step;
      top = from < 0 ? std::max(top, along) : top;
      back = std::max(back, top - along);
    }
    // Slopes of up to 6 bend by up to 6 step^2 / (2 kPoints)^2 between the points; where the pilot
    // slows down those of up to 6 / 0.2 by up to 30 (2 0.8 / 0.2)^2 / (2 kPoints)^2.
    EXPECT_NEAR(seen.least_slope, least, bend == 0 ? 1e-7 : 2e-6);
    // The longest way back is found; where a cubic goes back twice the points measure both.
    if (seen.back == 0) {
      EXPECT_LT(back, 1e-12);
      ++without;
    } else {
      EXPECT_GT(seen.back, 0.5 * back - 1e-9);
      EXPECT_LT(seen.back, back + 1e-9);
      if (seen.back > 1e-6) {
        EXPECT_NEAR(seen.from, from, 2e-2);
      }
      ++with_bump;
    }
  }
  EXPECT_GT(with_bump, 100);
  EXPECT_GT(without, 50);
}

// On random sheets: where the cubics of a path in steps of a degree see a diagonal go back, against
// its lengths every hundredth of one.
TEST(LookBetween, SeesWhereDiagonalsOfRealPathsGoBackSlow) {
  const DrawableSheet sheets(6, 6);
  const ShiftBlock block = sheets.draws(400 / kFewer, kSeed);
  int bumps = 0, smooth = 0;
  for (int i = 0; i < block.sheets; ++i) {
    const FlatVertices vertices_mm = sheets.vertices(block, i);
    const auto coarse = sheets.history(vertices_mm);
    const Between& seen = coarse.between;
    const bool has_bump = seen.back_where >= 0;
    if (coarse.verdict.deploys_from_sample < 10 || (has_bump ? bumps : smooth) >= 2) continue;
    (has_bump ? bumps : smooth) += 1;
    PathPlanOptions finely;
    finely.end_deg = coarse.verdict.deploys_from_sample;
    finely.look_deg = 0.01;
    const auto fine = sheets.history(vertices_mm, finely);
    // The first way back of any diagonal by more than the band, in mm.
    double first_deg = -1;
    int where = -1;
    for (Eigen::Index d = 0; d < fine.length_mm.cols(); ++d) {
      const Eigen::Index last = fine.length_mm.rows() - 1;
      const double direction = fine.length_mm(last, d) > fine.flat_mm[d] ? 1 : -1;
      double top = direction * fine.flat_mm[d], top_deg = 0;
      for (Eigen::Index row = 0; row <= last; ++row) {
        const double along = direction * fine.length_mm(row, d);
        if (along >= top) {
          top = along;
          top_deg = fine.stations[row].pilot_deg;
        } else if (top - along > 80 * kBumpBand_widths && (where < 0 || top_deg < first_deg)) {
          first_deg = top_deg;
          where = static_cast<int>(d);
          break;
        }
      }
    }
    EXPECT_EQ(where, seen.back_where) << "sheet " << i;
    if (has_bump) {
      EXPECT_NEAR(seen.back_deg, first_deg, 0.03) << "sheet " << i;
      EXPECT_LT(seen.least_slope, 0);
    } else {
      EXPECT_GT(seen.least_slope, 0);
    }
  }
  EXPECT_GT(smooth, 0);
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_GT(bumps, 0) << "no sheet goes back among the draws";
#endif
}

// With the bump a fault, D is the sample before it, and lanes and dense matrices agree.
TEST(LookBetween, BumpIsAFaultWhereThatWasAskedFor) {
  const DrawableSheet sheets(6, 6);
  const Model strict(sheets.base, sheets.shifted_vertices, {}, 150, {BumpRule::by_cubic});
  const Model lenient = sheets.with_threshold(150);
  const ShiftBlock block = sheets.draws(1000 / kFewer, kSeed);
  const auto judge = [&](const Model& model) {
    return make_batch(available_instruction_sets().back(), model)->judge(block);
  };
  const std::vector<Verdict> with = judge(strict), without = judge(lenient);
  int faults = 0;
  for (int i = 0; i < block.sheets; ++i) {
    const bool turns = with[i].first_fault == Fault::reverses_between;
    if (!turns && with[i].first_fault != Fault::bump) {
      EXPECT_EQ(words(with[i]), words(without[i]));
      continue;
    }
    if (++faults > 5) continue;
    const int d = with[i].deploys_from_sample;
    EXPECT_LT(d, without[i].deploys_from_sample);
    const auto history = record_with_pivoting(lenient, sheets.vertices(block, i));
    EXPECT_EQ(with[i].where, history.between.back_where);
    EXPECT_EQ(d, static_cast<int>(history.between.back_deg));
    // Row k is the sample k + 1.
    const double on_mm =
        history.length_mm(d, with[i].where) - history.length_mm(d - 1, with[i].where);
    EXPECT_EQ(turns, on_mm * history.slope_mm_per_deg(d, with[i].where) < 0);
  }
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_GT(faults, 0);
#endif
}

}  // namespace
}  // namespace misalign::solver
