// Batch of a model with spare equations: of sheets that fold by their base's own fold angles, in
// closed form and without lanes.
#pragma once

#include "solver/judging/base_judge.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::solver {

/// No test rejects a sheet, and no path is followed: what takes time is the record of those that
/// deploy from the threshold.
class BaseBatch final : public Batch {
 public:
  explicit BaseBatch(const Model& model) : model_(model), judge_(model) {}
  ~BaseBatch() override;

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

}  // namespace misalign::solver
