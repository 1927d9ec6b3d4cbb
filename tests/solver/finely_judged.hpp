// A path between its samples, from solves in steps of a hundredth of a degree or so: the yardstick
// for what is said by polynomials, or by fewer solves.
#pragma once

#include <cmath>

#include "solver/records/record_sheet.hpp"

namespace misalign::solver {

struct FineVerdict {
  Verdict samples;       ///< of the samples alone
  int bump_sample = 0;   ///< the first that a diagonal goes back before, of those in order; 0: none
  int bump_where = -1;   ///< which one, the most
  double bump_back = 0;  ///< how far, panel widths
  bool turned = false;   ///< whether it still goes back at that sample
  double nearest = HUGE_VAL;  ///< of all that was compared with the band up to there: the nearest

  /// What BumpRule::exact is to say.
  Verdict exact() const {
    if (bump_sample == 0) return samples;
    return {bump_sample - 1, turned ? Fault::reverses_between : Fault::bump, bump_where,
            PathEnd::stopped};
  }
};

/// Whether a diagonal's step to this row is against its direction.
inline bool steps_back(const FoldingHistory& history, Eigen::Index row,
                       const std::vector<double>& before_mm, const std::vector<int>& directions,
                       double band_mm) {
  for (Eigen::Index d = 0; d < history.length_mm.cols(); ++d) {
    const auto k = static_cast<std::size_t>(d);
    if (directions[k] * (history.length_mm(row, d) - before_mm[k]) <= -band_mm) return true;
  }
  return false;
}

/// `base` as its path is sampled; all its sheets' diagonals are in use.
inline FineVerdict judge_finely(const PerforatedSheet& base, PathPlanOptions path, double step_deg,
                                const FlatVertices& vertices_mm) {
  const Verdict samples = record_history(Model(base, path), vertices_mm).verdict;
  FineVerdict verdict{samples};
  // D is put at 0 for an inactive diagonal once all is over: before that samples were in order.
  if (samples.first_fault != Fault::inactive_diagonal) {
    if (samples.deploys_from_sample == 0) return verdict;
    path.end_deg = samples.deploys_from_sample * path.sample_deg;
  }
  path.look_deg = step_deg;
  const Model fine(base, path);
  const FoldingHistory history = record_history(fine, vertices_mm);
  const double width_mm = fine.mechanism().panel_width_mm;
  const Eigen::Index diagonals = history.length_mm.cols();
  // Since the last sample: how far it came, and how far back it went; in mm.
  std::vector<double> most(history.flat_mm), last(history.flat_mm), slopes(most.size(), 0.0);
  std::vector<double> back(most.size(), 0.0);
  std::vector<int> directions(most.size(), 0);
  double last_deg = 0;
  std::vector<double> at_sample(history.flat_mm);
  Eigen::Index first = 0;  // of the stations since the last sample
  for (Eigen::Index row = 0; row < history.length_mm.rows(); ++row) {
    const Station& station = history.stations[static_cast<std::size_t>(row)];
    if (station.sample == 0) continue;
    const double band_mm = kStepBand_widths * width_mm;
    if (steps_back(history, row, at_sample, directions, band_mm)) return verdict;
    double longest = 0;
    for (Eigen::Index d = 0; d < diagonals; ++d) {
      const auto k = static_cast<std::size_t>(d);
      const double step = history.length_mm(row, d) - at_sample[k];
      if (directions[k] == 0 && std::abs(step) >= band_mm) {
        directions[k] = step > 0 ? 1 : -1;
      }
      at_sample[k] = history.length_mm(row, d);
      if (directions[k] == 0) continue;
      double farthest = directions[k] * last[k], here = farthest, longest_back = 0;
      double from_deg = last_deg, slope = directions[k] * slopes[k];
      const auto pass = [&](double length) {
        farthest = std::max(farthest, length);
        longest_back = std::max(longest_back, farthest - length);
      };
      for (Eigen::Index i = first; i <= row; ++i) {
        const double to_deg = history.stations[static_cast<std::size_t>(i)].pilot_deg;
        const double next = directions[k] * history.length_mm(i, d);
        const double next_slope = directions[k] * history.slope_mm_per_deg(i, d);
        if ((slope > 0) != (next_slope > 0) && i > 0) {
          // Nearly a parabola: to its turn from the nearer end.
          const double share = slope / (slope - next_slope), width = to_deg - from_deg;
          pass(share < 0.5 ? here + slope * share * width / 2
                           : next - next_slope * (1 - share) * width / 2);
        }
        pass(next);
        here = next;
        slope = next_slope;
        from_deg = to_deg;
      }
      longest_back /= width_mm;
      verdict.nearest = std::min(verdict.nearest, std::abs(longest_back - kBumpBand_widths));
      if (longest_back >= kBumpBand_widths && longest_back > longest) {
        longest = longest_back;
        verdict.bump_sample = station.sample;
        verdict.bump_where = static_cast<int>(d);
        verdict.bump_back = longest_back;
        verdict.turned = slope < 0;
      }
    }
    if (verdict.bump_sample > 0) return verdict;
    for (Eigen::Index d = 0; d < diagonals; ++d) {
      last[static_cast<std::size_t>(d)] = history.length_mm(row, d);
      slopes[static_cast<std::size_t>(d)] = history.slope_mm_per_deg(row, d);
    }
    first = row + 1;
    last_deg = station.pilot_deg;
  }
  return verdict;
}

}  // namespace misalign::solver
