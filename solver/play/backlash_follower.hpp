// Backlash: whether a sheet still moves one way when its joints have play. Every joint has settled
// somewhere within its play and stays there (LooseSheet); the path is followed from the middle of
// the range that is asked about, up and down, and further down until it is lost: flat is no state
// of such a sheet.
#pragma once

#include <memory>
#include <vector>

#include "solver/kinematics/loose_sheet.hpp"
#include "solver/play/backlash_start.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// One sheet with its joints settled in one way.
struct BacklashTrial {
  /// The end of the way down.
  enum class BranchEnd {
    flat,          ///< it does not: the pilot comes to 0 with every crease on its side
    turns,         ///< the pilot reaches a limit point, from which it opens again
    other_branch,  ///< a crease passes 0, from mountain to valley or back
    not_known      ///< a numerical failure: it was followed so far
  };

  bool is_known = true;  ///< false: a numerical failure
  /// The range round the start in which every sample is in order: the path exists, no crease
  /// passes 180 degrees, each keeps its sign and each diagonal goes on as the sheet's own does.
  /// from_deg to D at the widest; as far as it was followed.
  double one_way_from_deg = 0, one_way_to_deg = 0;
  Fault fault = Fault::none;  ///< what ends it within from_deg to D; above, if both ends do
  double lost_deg = 0;        ///< where the branch ends on the way down; only if asked for
  BranchEnd lost = BranchEnd::not_known;
  double gap_widths = 0;  ///< the largest vertex_gap at a sample of it; only if asked for

  bool moves_one_way() const { return is_known && fault == Fault::none; }
};

/// Judges one sheet with its joints here and there. Owns its memory.
class BacklashFollower {
 public:
  /// Both must outlive this object; D of the sheet is above from_deg.
  BacklashFollower(const Model& model, const BacklashStart& sheet, const BacklashOptions& options);
  ~BacklashFollower();

  /// With `scale` (panel widths per unit) of these offsets. `only_whether`: stops where it is known
  /// that the sheet does not move one way, and goes no further down than from_deg.
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
