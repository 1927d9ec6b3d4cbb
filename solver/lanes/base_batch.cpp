#include "solver/lanes/base_batch.hpp"

#include "solver/judging/sheet_queue.hpp"
#include "solver/records/base_history.hpp"

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

}  // namespace

BaseBatch::~BaseBatch() = default;

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

}  // namespace misalign::solver
