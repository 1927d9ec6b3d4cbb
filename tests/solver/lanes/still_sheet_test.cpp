// Meshes that fold flat with all their panels: a hole of such a sheet is as rigid as the panel that
// was taken out of it, so that every diagonal stands still. Near 180 degrees, where all creases
// close at once, the paths of several are lost.
#include <algorithm>

#include "solver/lanes/batch.hpp"
#include "solver/reference/reference.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

constexpr double kSide_mm = 80;

// A double corrugation surface: all panels are congruent parallelograms, and both families of
// creases zigzags, at these angles to the axes (a Miura-ori has 0 and its own).
struct Corrugation {
  int rows, columns;
  double across_deg, up_deg;

  PerforatedSheet base() const {
    const auto shape = MiuraShape::uniform(rows, columns, kSide_mm, kSide_mm, kSide_mm / 2);
    PerforatedSheet base;
    base.sheet = miura_sheet(shape);
    const auto zigzag = [](double angle_deg, int steps) -> Eigen::Vector2d {
      const double angle = angle_deg * kRadPerDeg;
      return Eigen::Vector2d(steps * std::cos(angle), steps % 2 * std::sin(angle)) * kSide_mm;
    };
    for (int i = 0; i <= rows; ++i) {
      for (int j = 0; j <= columns; ++j) {
        const Eigen::Vector2d across = zigzag(across_deg, j), up = zigzag(up_deg, i);
        base.sheet.vertices_mm.col(i * (columns + 1) + j) << across.x() + up.y(),
            across.y() + up.x();
      }
    }
    base.holes = checkerboard(base.sheet, 1);
    base.folding = std::get<BaseFolding>(fold_sequentially(
        base.sheet, miura_assignment(shape, base.sheet), default_pilot(base.sheet, base.holes)));
    return base;
  }
};

class StillSheet : public testing::TestWithParam<Corrugation> {};

// On the second all paths are lost at 180 degrees.
INSTANTIATE_TEST_SUITE_P(Corrugations, StillSheet,
                         testing::Values(Corrugation{6, 6, 9, 15}, Corrugation{8, 8, 14, 23}),
                         [](const auto& of) {
                           return std::to_string(of.param.rows) + "x" +
                                  std::to_string(of.param.columns);
                         });

TEST_P(StillSheet, IsInactiveByEveryJudge) {
  const PerforatedSheet base = GetParam().base();
  ASSERT_EQ(base.folding.end_deg(), 180);
  const std::vector<int> shifted = interior_vertices(base.sheet);
  const ShiftBlock block{std::vector<double>(2 * shifted.size(), 0.0), 1};
  const auto expect_inactive = [](const Verdict& verdict, const std::string& by) {
    EXPECT_EQ(verdict.first_fault, Fault::inactive_diagonal) << by;
    EXPECT_EQ(verdict.deploys_from_sample, 0) << by;
  };
  for (const BumpRule bumps : {BumpRule::ignored, BumpRule::exact}) {
    Criterion criterion{bumps};
    criterion.scores = true;
    const Model model(base, shifted, {}, 170, criterion);
    for (const InstructionSet set : available_instruction_sets()) {
      const auto batch = make_batch(set, model);
      const Verdict verdict = batch->judge(block).front();
      expect_inactive(verdict, instruction_set_name(set));
      EXPECT_EQ(verdict.score, kNoScore);
      expect_inactive(batch->measure(block).front().verdict, "measured");
      expect_inactive(batch->record(block).front().verdict, "recorded");
    }
  }
  const Model model(base, PathPlanOptions{});
  expect_inactive(record_history(model, base.sheet.vertices_mm).verdict, "history");
  expect_inactive(record_with_pivoting(model, base.sheet.vertices_mm).verdict, "dense matrices");
  Reference reference(model.mechanism(), model.path());
  expect_inactive(reference.judge(base.sheet.vertices_mm), "reference");
}

}  // namespace
}  // namespace misalign::solver
