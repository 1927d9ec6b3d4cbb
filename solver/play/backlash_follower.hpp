// Judges whether a sheet still moves in one way when its joints have play. Every joint has settled
// somewhere within its play and stays there (LooseSheet); the path is followed from the middle of
// the range of angles, up and down, and further down until the branch ends: flat is no state of
// such a sheet.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "solver/kinematics/loose_sheet.hpp"
#include "solver/play/backlash_start.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// One sheet with its joints settled in one way.
struct BacklashTrial {
  /// The end of the way down.
  enum class BranchEnd {
    flat,          ///< no end: the pilot reaches 0 with every crease on its side
    turns,         ///< the pilot reaches a limit point, from which it opens again
    other_branch,  ///< a crease passes 0, from mountain to valley or back
    not_known      ///< a numerical failure: the end of what was followed
  };

  bool is_known = true;  ///< false: a numerical failure
  /// The range round the start in which every sample is in order: the path exists, no crease passes
  /// 180 degrees, each keeps its sign and each diagonal changes in the same direction as without
  /// play. At most from_deg to D, and as far as it was followed.
  double one_way_from_deg = 0, one_way_to_deg = 0;
  Fault fault =
      Fault::none;      ///< reason of its end within from_deg to D; the upper one, if there are two
  double lost_deg = 0;  ///< end of the branch on the way down; only if requested
  BranchEnd lost = BranchEnd::not_known;
  double gap_widths = 0;  ///< the largest vertex_gap at its samples; only if requested
  /// Pilot angle where its filling stops it, let go where its way up ends, at D or a fault; 0: not
  /// above from_deg, or the way down ends before. None: it is held, or the sheet has no filling, or
  /// it is not requested. Error: some hundredths of a degree.
  std::optional<double> stop_deg;

  bool moves_one_way() const { return is_known && fault == Fault::none; }
};

/// Judges one sheet with its joints settled anywhere. Owns its memory.
class BacklashFollower {
 public:
  /// Both must outlive this object; D of the sheet is above from_deg.
  BacklashFollower(const Model& model, const BacklashStart& sheet, const BacklashOptions& options);
  ~BacklashFollower();

  /// Follows a trial with these offsets times `scale` (panel widths per unit). `only_whether`: ends
  /// where the sheet is known not to move in one way, and goes no further down than from_deg.
  BacklashTrial trial(const JointOffsets& offsets, double scale, bool only_whether);

 private:
  class Branch;
  struct Followers;

  PathResult follow(Branch& branch);
  void find_start(const JointOffsets& offsets, double scale);

  const Model& model_;
  const BacklashStart& sheet_;
  const BacklashOptions options_;
  PathPlan up_, down_;
  LooseSheet<double> loose_;
  FoldState<double> start_;
  std::unique_ptr<Followers> followers_;
};

}  // namespace misalign::solver
