// `misalign tolerance --backlash`: judges a sheet whose joints have play, many times, each time
// with other offsets of every joint.
#pragma once

#include <functional>

#include "search/sheets/tolerance.hpp"
#include "solver/play/backlash.hpp"

namespace misalign::search {

/// The k-th point of trial t, uniform in the unit ball: the first in the ball of points of the cube
/// round it, whose coordinates are uniform ones as above from words 0 to 2 of blocks 64 k,
/// 64 k + 1, ... (One in two lies in it.)
solver::Vec3<double> point_in_ball(std::uint64_t seed, std::uint64_t trial, std::uint32_t k);

/// Offsets of the joints in trial t, as a share of their play: points 2i and 2i + 1 are
/// crease i's at a and at b, in the mechanism's order, and then those of the ball joints.
solver::JointOffsets trial_offsets(const solver::Mechanism& mechanism, std::uint64_t seed,
                                   std::uint64_t trial);

struct BacklashStudyOptions {
  double backlash_mm = 0;       ///< radius of the ball in which each joint's offsets lie
  std::uint64_t trials = 1000;  ///< trials 0 to this
  int jobs = 1;                 ///< threads; the answer does not depend on them
  std::function<void(const CopiesDone&)> progress{};  ///< called now and then, one call at a time
};

/// Accuracy of the largest backlash: its logarithm is bisected until a good and a bad radius are
/// within this ratio. The share of 1,000 trials is known to 1.4 % only.
inline constexpr double kRadiusRatio = 1.01;
/// The smallest backlash that is tried, as a share of the panel width: 0.08 micrometres on 80 mm.
inline constexpr double kLeastBacklash_widths = 1e-6;
/// The largest backlash that is tried, as a share of the shortest crease: beyond it a hinge's line
/// may point anywhere near.
inline constexpr double kMostBacklash_creases = 0.1;

class BacklashStudy {
 public:
  /// Follows the paths of the campaign's sheets with these shifts (one column per vertex). Trials
  /// of a sheet that its filling stops short of flat have stops. UserError (bad_request) as from
  /// filling_made_for.
  BacklashStudy(const schema::Campaign& campaign, const std::vector<Eigen::Matrix2Xd>& shifts_mm,
                const solver::BacklashOptions& options,
                const std::optional<solver::Fill>& fill = {});

  /// The sheets themselves. D of each must be above from_deg before run() is called,
  const std::vector<solver::BacklashStart>& sheets() const { return sheets_; }
  /// and the backlash below this.
  double most_mm(std::size_t sheet) const;

  /// One answer for each sheet. Trial t is the same for all sheets of a campaign.
  std::vector<solver::Backlash> run(const BacklashStudyOptions& options) const;

 private:
  const solver::Model model_;
  const std::uint64_t seed_;
  const solver::BacklashOptions options_;
  std::vector<solver::BacklashStart> sheets_;
};

}  // namespace misalign::search
