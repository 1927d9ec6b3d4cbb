// A folding path as JSON: what `fold`, `replay` and `export` write.
#pragma once

#include <optional>
#include <string>

#include "schema/campaign/campaign.hpp"
#include "solver/verdict/metrics.hpp"

namespace misalign::schema {

/// What every such file begins with: pattern with these shifts, unknowns, verdict, fold limit.
struct FoldingView {
  const Pattern& base;
  const Eigen::Matrix2Xd& shifts_mm;
  const solver::Mechanism& mechanism;
  const solver::FoldingHistory& history;
  double sample_deg;
};

/// {"hole": [row, column], "from", "to", "flat_mm"}
Json diagonal_json(const Pattern& base, const solver::Mechanism& mechanism,
                   const solver::Diagonal& diagonal, double flat_mm);

/// Those of a campaign's base pattern, as its catalogue keeps them: a list of diagonal_json.
Json diagonals_json(const Campaign& campaign, const solver::Mechanism& mechanism);

/// "A17-A23" of a diagonal or crease that a verdict names; empty if it names none.
std::string where_label(const solver::Mechanism& mechanism, const solver::Verdict& verdict);

/// "start_lost" or "stalled".
const char* undecided_cause(const solver::Verdict& verdict);

/// {"deploys_from_deg", "first_fault", "fault_deg", "where", ...}; fault_deg and where may be null.
Json verdict_json(const FoldingView& view);

/// {"from_deg", "where"} of the first bump between samples up to D; null if none was seen.
Json bump_json(const FoldingView& view);

/// The contract's `fold --json`.
Json folding_json(const FoldingView& view);

/// The metrics under the names of their columns.
Json metrics_json(const solver::Metrics& metrics);

/// What is exported of a sheet (candidate.schema.json): metrics and elongations are null for one
/// that deploys from nothing.
Json folded_pattern_json(const Sampling& sampling, const FoldingView& view,
                         const std::optional<solver::Metrics>& metrics, const Json& actuation);

/// What a candidate's export says besides: {"campaign": {"name", "identity"}, "draw", "yields"},
/// the last as from yields_json.
Json origin_json(const Campaign& campaign, std::uint64_t draw, const Json& yields);

}  // namespace misalign::schema
