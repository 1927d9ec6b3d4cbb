// Speed of the lanes against the frozen reference, and whether their verdicts are the same, in one
// run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/campaign/campaign.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search {

struct BenchOptions {
  std::string campaign_path;  ///< empty: the default campaign
  double seconds = 3;         ///< for each solver; taken in turns
  /// Instead of speed: every verdict on so many draws, at many thresholds.
  std::optional<std::uint64_t> agree_draws;
  bool json = false;
};

/// What one solver did with a campaign's draws, one after another from draw 0.
struct SolverSpeed {
  std::uint64_t draws = 0;
  double seconds = 0;
  solver::Effort effort;
  std::uint64_t disagreements = 0;  ///< with the reference, on the draws that both did

  double draws_per_s() const { return static_cast<double>(draws) / seconds; }
};

struct SpeedReport {
  SolverSpeed reference;  ///< dense, every sample, up to the first fault
  std::vector<std::pair<solver::InstructionSet, SolverSpeed>> lanes;
};

SpeedReport measure_speed(const schema::Campaign& campaign, double seconds);

/// Verdicts of the fast path against the reference's, on draws from 0 on.
struct AgreementReport {
  std::uint64_t draws = 0, undecided = 0;
  std::uint64_t verdicts_differ = 0;   ///< D, first fault or place, on the full path
  std::uint64_t reference_jumped = 0;  ///< they differed until the reference took finer steps
  std::uint64_t decisions = 0;  ///< at thresholds of every tenth degree, at each draw's own D
                                ///< and one sample above
  std::uint64_t decisions_differ = 0;
  std::vector<std::uint64_t> differing_draws;  ///< the first few
};

AgreementReport compare_verdicts(const schema::Campaign& campaign, std::uint64_t draws,
                                 solver::InstructionSet set);

/// Runs what the options ask for and prints it; false if anything disagreed.
bool bench(const BenchOptions& options);

}  // namespace misalign::search
