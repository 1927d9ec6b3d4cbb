// The science of one draw: draw -> displaced pattern -> path -> diagonals -> verdict -> metrics.
#pragma once

#include <optional>

#include "schema/catalogue.hpp"
#include "solver/reference.hpp"

namespace misalign::search {

/// What became of a draw; `candidate` when it deploys from the campaign's threshold.
struct Outcome {
  solver::Verdict verdict;
  std::optional<schema::Candidate> candidate;
};

/// One campaign made ready: what all of its draws share, and the workspace of this rank.
class Trial {
 public:
  explicit Trial(schema::Campaign campaign);
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  Outcome run(std::uint64_t draw);

  /// Everything about one draw, accepted or not.
  solver::FoldingHistory history(std::uint64_t draw);
  /// Shifts of the draw that was run or looked at last, one column per vertex.
  const Eigen::Matrix2Xd& shifts_mm() const { return shifts_mm_; }

  const schema::Campaign& campaign() const { return campaign_; }
  const solver::Mechanism& mechanism() const { return mechanism_; }

  /// Whether the campaign wants a draw with this verdict.
  bool accepts(const solver::Verdict& verdict) const;

 private:
  void displace(std::uint64_t draw);

  schema::Campaign campaign_;
  solver::Mechanism mechanism_;
  solver::PathPlan plan_;
  solver::Reference reference_;
  Eigen::Matrix2Xd shifts_mm_;
  solver::FlatVertices vertices_mm_;
};

/// Fingerprint of this build's verdicts on fixed draws of a small sheet: whole numbers, the same
/// for every build whose verdicts can be trusted to agree.
std::string golden_verdicts();

/// A range of draws being worked off, one draw at a time.
class UnitWork {
 public:
  UnitWork(Trial& trial, const schema::DrawRange& range);

  bool finished() const { return next_ == range_.hi; }
  void run_next_draw();
  /// What has been done so far: from the range's start up to the next draw.
  schema::UnitRecord take();

 private:
  Trial& trial_;
  schema::DrawRange range_;
  std::uint64_t next_;
  schema::UnitRecord record_;
};

}  // namespace misalign::search
