// Batches through their public interface, for every instruction set: bit for bit what one lane of
// doubles gives, whoever the neighbours are.
#include "solver/lanes/batch.hpp"

#include <limits>

#include "solver/lanes/lane_batch.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

/// The definition: a register of one lane.
using ScalarBatch = LaneBatch<double, float>;

class BatchTest : public testing::TestWithParam<InstructionSet> {
 protected:
  std::unique_ptr<Batch> batch(const Model& model) const { return make_batch(GetParam(), model); }
};

INSTANTIATE_TEST_SUITE_P(InstructionSets, BatchTest,
                         testing::ValuesIn(available_instruction_sets()), [](const auto& set) {
                           return std::string(instruction_set_name(set.param));
                         });

TEST(InstructionSets, BaselineIsThereEverywhere) {
  const auto sets = available_instruction_sets();
  ASSERT_FALSE(sets.empty());
  EXPECT_EQ(sets[0], InstructionSet::baseline);
}

TEST_P(BatchTest, FullAndPartialBatchesAreBitForBitTheScalarOnes) {
  const DrawableSheet sheets(6, 6);
  const Model model = sheets.with_threshold(160, {}, 0.4);
  const auto batch = this->batch(model);
  ScalarBatch scalar(model);
  for (const int count : {1, 2, 3, 7, 8, 9, 17, 40}) {
    SCOPED_TRACE(count);
    const ShiftBlock block = sheets.draws(count, kSeed + count);
    EXPECT_EQ(words(batch->judge(block)), words(scalar.judge(block)));
    EXPECT_EQ(words(batch->reject(block)), words(scalar.reject(block)));
  }
  EXPECT_EQ(batch->path_effort().solves, scalar.path_effort().solves);
  EXPECT_EQ(batch->path_effort().iterations, scalar.path_effort().iterations);
  EXPECT_EQ(batch->rejection_effort().iterations, scalar.rejection_effort().iterations);
}

// There pivots are eliminated in blocks, in tiles that differ from one instruction set to another.
TEST_P(BatchTest, LargeSheetsAreBitForBitTheScalarOnes) {
  const DrawableSheet sheets(14, 14);
  const Model model = sheets.with_threshold(0, {.end_deg = 6});
  const auto batch = this->batch(model);
  const ShiftBlock block = sheets.draws(9, kSeed);
  ScalarBatch scalar(model);
  EXPECT_EQ(words(batch->judge(block)), words(scalar.judge(block)));
  const std::vector<FoldingHistory> histories = batch->record(block);
  const auto& alone = scalar.record(block);
  const auto& lengths = batch->record_lengths(block);
  for (int i = 0; i < block.sheets; ++i) {
    EXPECT_EQ(histories[i].stations.size(), 6u);
    EXPECT_EQ(histories[i].length_mm, alone[i].length_mm);
    EXPECT_EQ(histories[i].slope_mm_per_deg, alone[i].slope_mm_per_deg);
    EXPECT_EQ(histories[i].fold_angle_deg, alone[i].fold_angle_deg);
    EXPECT_EQ(histories[i].singular_value_min.size(), 6u);
    EXPECT_EQ(lengths[i].length_mm, histories[i].length_mm);
    EXPECT_EQ(lengths[i].slope_mm_per_deg, histories[i].slope_mm_per_deg);
    EXPECT_EQ(lengths[i].singular_value_min, std::vector<double>(6, 0.0));
  }
}

TEST_P(BatchTest, NothingToDo) {
  const DrawableSheet sheets(4, 4);
  const Model model = sheets.with_threshold(150);
  const auto batch = this->batch(model);
  const ShiftBlock none;
  EXPECT_TRUE(batch->reject(none).empty());
  EXPECT_TRUE(batch->judge(none).empty());
  EXPECT_TRUE(batch->record(none).empty());
}

// Between ordinary sheets: large shifts, whose paths need another start, have none or turn early,
// coordinates that are no number, and vertices that fall on each other.
TEST_P(BatchTest, FailingNeighboursChangeNothingSlow) {
  const DrawableSheet sheets(6, 6);
  const Model model = sheets.with_threshold(160, {}, kFewer == 1 ? 0.4 : 0);
  const auto batch = this->batch(model);
  const ShiftBlock healthy = sheets.draws(24, kSeed);
  const std::vector<std::string> alone = words(ScalarBatch(model).judge(healthy));
  const std::vector<std::string> rejected_alone = words(ScalarBatch(model).reject(healthy));

  ShiftBlock mixed = healthy;
  mixed.sheets = 0;
  mixed.shifts_mm.clear();
  std::vector<int> healthy_places;
  const auto append = [&](const ShiftBlock& from, int i) {
    mixed.shifts_mm.insert(mixed.shifts_mm.end(), from.of(i),
                           from.of(i) + 2 * sheets.shifted_vertices.size());
    return mixed.sheets++;
  };
  ShiftBlock broken = sheets.draws(3, kSeed);
  const std::size_t size = 2 * sheets.shifted_vertices.size();
  broken.shifts_mm[7] = std::numeric_limits<double>::quiet_NaN();
  broken.shifts_mm[size + 9] = std::numeric_limits<double>::infinity();
  broken.shifts_mm[2 * size] = 80;  // A9 on A10
  broken.shifts_mm[2 * size + 1] = 0;
  broken.shifts_mm[2 * size + 2] = broken.shifts_mm[2 * size + 3] = 0;
  const ShiftBlock large = sheets.draws(8, kSeed, 8), huge = sheets.draws(8, kSeed, 12);
  for (int i = 0; i < healthy.sheets; ++i) {
    healthy_places.push_back(append(healthy, i));
    append(i % 3 == 0 ? broken : i % 3 == 1 ? large : huge, (i / 3) % (i % 3 == 0 ? 3 : 8));
  }
  const auto& verdicts = batch->judge(mixed);
  const auto& rejections = batch->reject(mixed);
  int without_start = 0;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(words(verdicts[healthy_places[i]]), alone[i]);
    EXPECT_EQ(words(rejections[healthy_places[i]]), rejected_alone[i]);
    const Verdict& neighbour = verdicts[healthy_places[i] + 1];
    without_start += words(neighbour) == "D 0, fold_limit at -1, end 2";
    if (i % 3 == 0 && i % 9 < 6) {
      EXPECT_EQ(words(neighbour), "D 0, undecided at -1, end 3") << "start_lost, and no verdict";
      EXPECT_EQ(rejections[healthy_places[i] + 1].fault, Fault::none) << "never a no";
    }
  }
  EXPECT_GT(without_start, 3);
  ScalarBatch scalar(model);
  EXPECT_EQ(words(batch->judge(mixed)), words(scalar.judge(mixed)));
}

// Whatever blocks they come in, in whatever order.
TEST_P(BatchTest, BlocksDoNotMatter) {
  const DrawableSheet sheets(6, 6);
  const Model model = sheets.with_threshold(155);
  const auto batch = this->batch(model);
  const ShiftBlock block = sheets.draws(120 / kFewer, kSeed);
  const std::vector<std::string> verdicts = words(batch->judge(block));
  const std::vector<std::string> rejections = words(batch->reject(block));

  std::vector<int> order = all_of(block);
  std::mt19937 shuffle(kSeed);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[shuffle() % i]);
  for (const std::size_t size : {std::size_t{1}, std::size_t{5}, std::size_t{64}, order.size()}) {
    SCOPED_TRACE(size);
    for (std::size_t first = 0; first < order.size(); first += size) {
      const std::vector<int> some(order.begin() + first,
                                  order.begin() + std::min(first + size, order.size()));
      const ShiftBlock part = chosen_of(block, some);
      const auto part_verdicts = words(batch->judge(part));
      const auto part_rejections = words(batch->reject(part));
      for (std::size_t i = 0; i < some.size(); ++i) {
        EXPECT_EQ(part_verdicts[i], verdicts[some[i]]);
        EXPECT_EQ(part_rejections[i], rejections[some[i]]);
      }
    }
  }
}

}  // namespace
}  // namespace misalign::solver
