// Judges any number of sheets of one model that come with their shifts, a block after another, in
// lanes: accepted or not, or the whole verdicts.
#pragma once

#include <functional>

#include "search/draws/draw_evaluator.hpp"

namespace misalign::search {

enum class Decision : std::uint8_t {
  rejected,   ///< does not deploy from the model's threshold
  accepted,   ///< does
  undecided,  ///< a numerical failure: neither
};

/// The verdict on a sheet with these shifts as single sheets have it: where the sheet closes at 180
/// degrees (schema::closes_at_180) that up to the sample before.
solver::Verdict before_closing(const solver::Model& model, const Eigen::Matrix2Xd& shifts_mm,
                               const solver::Verdict& verdict);

/// How many samples reach this angle, an option `threshold_deg`. UserError (bad_request) unless a
/// whole, positive number does before the path ends.
int threshold_sample_of(double threshold_deg, const schema::Sampling& sampling);

/// One thread's, for one array of sheets.
class DecisionStream {
 public:
  /// Both must outlive this object; nobody else uses the batch meanwhile.
  DecisionStream(const solver::Model& model, solver::Batch& batch);

  /// How many sheets the next block had best have.
  std::uint64_t next_block() const { return block_size_.now(); }

  /// What is known of the sheet with this number. Each sheet is answered once, in any order.
  using TellDecision = std::function<void(std::uint64_t number, Decision decision)>;
  /// Judges a block by the model's threshold (there is one). Those that no test rejects wait for
  /// their full paths until they fill the lanes.
  void accept(const Draws& block, const TellDecision& tell);
  /// The full paths of all that wait.
  void finish(const TellDecision& tell);

  /// Everything, each on its full path; in their order.
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
