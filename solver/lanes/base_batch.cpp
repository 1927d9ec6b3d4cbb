// Judges the sheets of an overconstrained model, which fold by the fold angles of their base: in
// closed form, without lanes.
#include "solver/judging/base_judge.hpp"
#include "solver/judging/sheet_queue.hpp"
#include "solver/lanes/batch.hpp"
#include "solver/lanes/lanes.hpp"
#include "solver/records/record_sheet.hpp"

namespace misalign::solver {
namespace {

template <class Each>
void for_each_sheet(const Model& model, const ShiftBlock& block, const Each& each) {
  const SheetBlock sheets(model, block);
  FlatVertices vertices_mm;
  for (int sheet = 0; sheet < block.sheets; ++sheet) {
    sheets.place(sheet, vertices_mm);
    each(vertices_mm);
  }
}

// No test rejects a sheet, and no path is followed: what takes time is the record of those that
// deploy from the threshold.
class BaseBatch final : public Batch {
 public:
  explicit BaseBatch(const Model& model) : model_(model), judge_(model) {}

  const std::vector<Rejection>& reject(const ShiftBlock& block) override;
  const std::vector<Verdict>& judge(const ShiftBlock& block) override;
  const std::vector<PathRecord>& measure(const ShiftBlock& block) override;
  std::vector<FoldingHistory>& record(const ShiftBlock& block) override;
  std::vector<FoldingHistory>& record_lengths(const ShiftBlock& block) override {
    return record(block);
  }
  double tables_deg() const override { return 0; }
  Effort rejection_effort() const override { return {}; }
  Effort path_effort() const override { return {}; }

 private:
  const Model& model_;
  BaseJudge judge_;
  std::vector<Rejection> rejections_;
  std::vector<Verdict> verdicts_;
  std::vector<PathRecord> records_;
  std::vector<FoldingHistory> histories_;
};

const std::vector<Rejection>& BaseBatch::reject(const ShiftBlock& block) {
  rejections_.assign(static_cast<std::size_t>(block.sheets), {});
  return rejections_;
}

const std::vector<Verdict>& BaseBatch::judge(const ShiftBlock& block) {
  verdicts_.clear();
  for_each_sheet(model_, block, [&](const FlatVertices& vertices_mm) {
    verdicts_.push_back(judge_.judge(vertices_mm));
  });
  return verdicts_;
}

const std::vector<PathRecord>& BaseBatch::measure(const ShiftBlock& block) {
  records_.clear();
  for_each_sheet(model_, block, [&](const FlatVertices& vertices_mm) {
    PathRecord& record = records_.emplace_back();
    record.verdict = judge_.judge(vertices_mm);
    if (record.verdict.deploys_from_sample < model_.threshold_sample()) return;
    record = record_of(record_on_base(model_, vertices_mm), model_.mechanism());
  });
  return records_;
}

std::vector<FoldingHistory>& BaseBatch::record(const ShiftBlock& block) {
  histories_.clear();
  for_each_sheet(model_, block, [&](const FlatVertices& vertices_mm) {
    histories_.push_back(record_on_base(model_, vertices_mm));
  });
  return histories_;
}

}  // namespace

std::unique_ptr<Batch> make_base_batch(const Model& model) {
  return std::make_unique<BaseBatch>(model);
}

}  // namespace misalign::solver
