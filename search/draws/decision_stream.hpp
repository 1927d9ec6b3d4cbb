// Judges any number of sheets of one model, block by block in lanes: accepted or not, or whole
// verdicts.
#pragma once

#include <functional>

#include "search/draws/draw_evaluator.hpp"

namespace misalign::search {

enum class Decision : std::uint8_t {
  rejected,   ///< deploys from less than the model's threshold
  accepted,   ///< deploys from the threshold
  undecided,  ///< a numerical failure: neither
};

/// Returns the verdict on a single sheet: if the sheet closes at 180 degrees
/// (schema::closes_at_180), the verdict up to the sample before.
solver::Verdict before_closing(const solver::Model& model, const Eigen::Matrix2Xd& shifts_mm,
                               const solver::Verdict& verdict);

/// Returns the sample at the option `threshold_deg`. UserError (bad_request) unless it is a
/// positive whole multiple of the sampling, within the path.
int threshold_sample_of(double threshold_deg, const schema::Sampling& sampling);

/// Judges one array of sheets in one thread.
class DecisionStream {
 public:
  /// Both must outlive this object; nobody else uses the batch meanwhile.
  DecisionStream(const solver::Model& model, solver::Batch& batch);

  /// Returns the best size of the next block.
  std::uint64_t next_block() const { return block_size_.now(); }

  /// Gets the decision on a numbered sheet; once for each sheet, in any order.
  using TellDecision = std::function<void(std::uint64_t number, Decision decision)>;
  /// Judges a block by the model's threshold, which must exist. Sheets that no test rejects wait
  /// for their full paths until they fill the lanes.
  void accept(const Draws& block, const TellDecision& tell);
  /// Follows the full paths of all waiting sheets.
  void finish(const TellDecision& tell);

  /// Judges each sheet on its full path, and returns the verdicts in the sheets' order.
  const std::vector<solver::Verdict>& judge(const solver::ShiftBlock& block);

 private:
  Decision decision_of(const solver::Verdict& verdict) const;
  const std::vector<solver::Verdict>& judge_whole(const solver::ShiftBlock& block);

  const solver::Model& model_;
  solver::Batch& batch_;
  BlockSize block_size_;
  Draws waiting_;
  std::vector<solver::Verdict> verdicts_;
  double seconds_per_path_;
};

}  // namespace misalign::search
