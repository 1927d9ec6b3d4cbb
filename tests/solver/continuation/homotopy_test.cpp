// Starts of sheets far from the base, against dense Newton steps, small ones of the shifts.
#include "solver/continuation/homotopy.hpp"

#include "solver/reference/arc_length.hpp"
#include "solver/reference/grown_start.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

class Starts : public testing::TestWithParam<double> {};

TEST_P(Starts, AreThoseOfTheBranchOfTheBaseFolding) {
  const DrawableSheet sheets(6, 6);
  const Model model = sheets.with_threshold(1);
  ShiftHomotopy<double> homotopy(model.mechanism(), model.elimination(), model.path(),
                                 sheets.base.sheet.vertices_mm);
  const ShiftBlock block = sheets.draws(60 / kFewer, kSeed, GetParam());
  std::vector<StartFinder::FarStart> starts(static_cast<std::size_t>(block.sheets),
                                            StartFinder::FarStart(sheets.mechanism));
  for (int i = 0; i < block.sheets; ++i) {
    place(sheets.mechanism, sheets.vertices(block, i), starts[i].geometry);
  }
  homotopy.find(starts);
  int found = 0, ended = 0;
  for (int i = 0; i < block.sheets; ++i) {
    const FlatVertices vertices_mm = sheets.vertices(block, i);
    const GrownStart expected = grow_start(sheets.mechanism, model.path().start,
                                           sheets.base.sheet.vertices_mm, vertices_mm);
    switch (starts[i].end) {
      case PathEnd::end_reached:
        ++found;
        EXPECT_EQ(expected.end, PathEnd::end_reached) << "sheet " << i;
        // Both closed to 1e-12, over a singular value of 1e-4 and more.
        EXPECT_LT(largest_half_sine(starts[i].state, expected.state), 1e-8) << "sheet " << i;
        break;
      case PathEnd::fold_limit:
        ++ended;
        EXPECT_EQ(expected.end, PathEnd::fold_limit) << "sheet " << i;
        break;
      default:
        ADD_FAILURE() << "sheet " << i << " was lost";
    }
  }
  EXPECT_GT(found, 0);
  EXPECT_EQ(ended > 0, GetParam() > 4) << "far shifts have no such folding, some of them";
}

INSTANTIATE_TEST_SUITE_P(Amplitudes, Starts, testing::Values(0.4, 8.0, 11.0),
                         [](const auto& amplitude) {
                           return std::to_string(static_cast<int>(10 * amplitude.param)) +
                                  "_tenths_mm";
                         });

// Where creases turn far while the shifts grow by a thousandth, 2,000 steps are not enough: draws
// 20063 and 49341 of 8 x 6 with shifts of 8 mm.
TEST(LargeShifts, HaveStartsAfterLongWays) {
  const DrawableSheet sheets(8, 6);
  const Model model = sheets.with_threshold(1);
  ShiftHomotopy<double> homotopy(model.mechanism(), model.elimination(), model.path(),
                                 sheets.base.sheet.vertices_mm);
  const struct {
    const char* signs;
    PathEnd end;
  } draws[] = {{"0000+0-0+-00-00-00---+0-00000-+--0++0+0--+-++-0-+00-0+-0-+--++++---0-+",
                PathEnd::end_reached},
               {"-++++--++0--+-0--0-0--+-0-+-0++0+0000-++-0++00++-0-----0-0+++++0--0+00",
                PathEnd::fold_limit}};
  for (const auto& [signs, end] : draws) {
    ShiftBlock block{{}, 1};
    for (const char* sign = signs; *sign != 0; ++sign) {
      block.shifts_mm.push_back(*sign == '+' ? 8 : *sign == '-' ? -8 : 0);
    }
    ASSERT_EQ(block.shifts_mm.size(), 2 * sheets.shifted_vertices.size());
    StartFinder::FarStart start(sheets.mechanism);
    const FlatVertices vertices_mm = sheets.vertices(block, 0);
    place(sheets.mechanism, vertices_mm, start.geometry);
    homotopy.find({&start, 1});
    ASSERT_EQ(start.end, end);
    const GrownStart expected = grow_start(sheets.mechanism, model.path().start,
                                           sheets.base.sheet.vertices_mm, vertices_mm);
    EXPECT_EQ(expected.end, end) << expected.share;
    if (end != PathEnd::end_reached) continue;
    EXPECT_LT(largest_half_sine(start.state, expected.state), 1e-8);
  }
}

// A block with such sheets gives what each of them gives alone, and none is undecided.
TEST(LargeShifts, AreDecidedInLanesSlow) {
  const DrawableSheet sheets(6, 6);
  const Model model = sheets.with_threshold(100);
  const ShiftBlock block = sheets.draws(40 / kFewer, kSeed, 10);
  for (const InstructionSet set : available_instruction_sets()) {
    const auto batch = make_batch(set, model);
    const std::vector<Verdict> together = batch->judge(block);
    const std::vector<FoldingHistory> histories = batch->record(block);
    for (int i = 0; i < block.sheets; ++i) {
      EXPECT_NE(together[i].first_fault, Fault::undecided) << "sheet " << i;
      EXPECT_EQ(words(together[i]), words(batch->judge(chosen_of(block, {i}))[0]));
      // Histories go on past the fault.
      const Verdict recorded = histories[i].verdict;
      const Verdict single = record_history(model, sheets.vertices(block, i)).verdict;
      for (const Verdict& other : {recorded, single}) {
        EXPECT_EQ(other.deploys_from_sample, together[i].deploys_from_sample) << "sheet " << i;
        EXPECT_EQ(other.first_fault, together[i].first_fault) << "sheet " << i;
        EXPECT_EQ(other.where, together[i].where) << "sheet " << i;
      }
    }
  }
}

}  // namespace
}  // namespace misalign::solver
