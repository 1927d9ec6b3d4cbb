// The hot loop owns its memory before it starts: every call of the C library's allocator is
// counted.
#include <algorithm>
#include <atomic>
#include <cstdlib>

#include "solver/reference/reference.hpp"
#include "tests/solver/blocks.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define MISALIGN_COUNTS_ALLOCATIONS 0  // the sanitizer has an allocator of its own
#else
#define MISALIGN_COUNTS_ALLOCATIONS 1
#endif

namespace {
std::atomic<long> allocations{0};
}

#if MISALIGN_COUNTS_ALLOCATIONS
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* realloc(void* old, std::size_t size) {
  ++allocations;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
}
#endif

namespace misalign::solver {
namespace {

TEST(Allocation, NoneInsideAPath) {
  if (!MISALIGN_COUNTS_ALLOCATIONS) GTEST_SKIP() << "not under a sanitizer";
  const Json odd = golden("table1_odd.json");
  const TestSheet sheet(6, 6, odd["holes"]);
  const PathPlan plan = sheet.plan();
  Reference reference(sheet.mechanism, plan);
  const FlatVertices limited = sheet.shifted(odd["displacements_mm"]);  // ends at a fold limit
  const FlatVertices base = sheet.base.sheet.vertices_mm;
  reference.judge(limited);

  const long before_control = allocations;
  std::vector<int>* control = new std::vector<int>(100);
  EXPECT_GT(allocations, before_control) << "the counter itself must work";
  delete control;

  const long before = allocations;
  const Verdict first = reference.judge(limited);
  const Verdict second = reference.judge(base);
  const long after = allocations;
  EXPECT_EQ(after - before, 0);
  EXPECT_EQ(first.first_fault, Fault::fold_limit);
  EXPECT_EQ(second.first_fault, Fault::inactive_diagonal);
}

class BatchAllocation : public testing::TestWithParam<InstructionSet> {
 protected:
  void expect_none(const Criterion& criterion);
};

// The threshold is far enough for steps ahead, and some sheets have no start.
void BatchAllocation::expect_none(const Criterion& criterion) {
  if (!MISALIGN_COUNTS_ALLOCATIONS) GTEST_SKIP() << "not under a sanitizer";
  const DrawableSheet sheets(6, 6);
  const Model model(sheets.base, sheets.shifted_vertices, {}, 165, criterion);
  const auto batch = make_batch(GetParam(), model);
  ShiftBlock block = sheets.draws(600, kSeed);
  const ShiftBlock large = sheets.draws(10, kSeed, 8);
  std::copy(large.shifts_mm.begin(), large.shifts_mm.end(), block.shifts_mm.begin());
  std::vector<int> numbers = all_of(block);
  numbers.resize(64);
  const ShiftBlock some = chosen_of(block, numbers);
  batch->reject(block);
  batch->judge(some);

  const long before = allocations;
  const auto& rejections = batch->reject(block);
  const long between = allocations;
  const auto& verdicts = batch->judge(some);
  const long after = allocations;
  EXPECT_EQ(between - before, 0) << "reject";
  EXPECT_EQ(after - between, 0) << "judge";
  const auto with = [](const auto& results, auto has) {
    return std::any_of(results.begin(), results.end(), has);
  };
  EXPECT_TRUE(with(rejections, [](const Rejection& s) { return s.fault == Fault::fold_limit; }));
  EXPECT_TRUE(with(verdicts, [](const Verdict& v) {
    return v.first_fault == Fault::fold_limit && v.deploys_from_sample == 0;
  })) << "a sheet without a start";
  const Fault usual = criterion.energy ? Fault::weak_drive : Fault::not_monotone;
  EXPECT_TRUE(with(verdicts, [&](const Verdict& v) { return v.first_fault == usual; }));
}

TEST_P(BatchAllocation, NoneInAWarmBatch) { expect_none({}); }
TEST_P(BatchAllocation, NoneBetweenSamples) { expect_none({BumpRule::exact}); }
TEST_P(BatchAllocation, NoneByEnergy) {
  Criterion springs, plates;
  springs.energy = EnergyCriterion{Springs{}, 165, 1};
  expect_none(springs);
  plates.energy = EnergyCriterion{RubberPlates{.prestretch = 1.1}, 165, 1, 0.1};
  expect_none(plates);
}
TEST_P(BatchAllocation, NoneForAStop) { expect_none({BumpRule::ignored, 60, 1e-3}); }

INSTANTIATE_TEST_SUITE_P(InstructionSets, BatchAllocation,
                         testing::ValuesIn(available_instruction_sets()), [](const auto& set) {
                           return std::string(instruction_set_name(set.param));
                         });

}  // namespace
}  // namespace misalign::solver
