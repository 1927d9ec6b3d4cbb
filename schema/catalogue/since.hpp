// Since which version of the schema a catalogue has what.
#pragma once

namespace misalign::schema {

inline constexpr int kBetweenSamplesSince =
    2;                                     ///< candidate: slope_between_min_mm_per_deg, bump_deg
inline constexpr int kRunSchemaSince = 2;  ///< run.schema_version
inline constexpr int kRelativeErrorSince = 3;   ///< campaign.goal_relative_error
inline constexpr int kCommitCostSince = 3;      ///< run: commits, commit_s, longest_commit_s
inline constexpr int kMiscutSince = 4;          ///< candidate.miscut_margin_mm, table yield
inline constexpr int kMetricsVersionSince = 4;  ///< run.metrics_version
/// fault_sample.stands_for: rows are the rarer the larger the draw's number. Rows of units whose
/// run had an older schema are every 1024 draws, however large, and stay.
inline constexpr int kRarerSampleSince = 4;

}  // namespace misalign::schema
