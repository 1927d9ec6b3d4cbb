// A folding path as JSON: what `fold`, `replay` and `export` write.
#pragma once

#include <optional>
#include <string>

#include "schema/catalogue/candidate_row.hpp"

namespace misalign::schema {

/// What every such file begins with: pattern with these shifts, unknowns, verdict, fold limit.
struct FoldingView {
  const Pattern& base;
  const Eigen::Matrix2Xd& shifts_mm;
  const solver::Mechanism& mechanism;
  const solver::FoldingHistory& history;
  double sample_deg;
};

/// {"deploys_from_deg", "first_fault", "fault_deg", "where", ...}; fault_deg and where may be null.
Json verdict_json(const FoldingView& view);

/// {"from_deg", "where"} of the history's first bump between samples, up to D or as the fault that
/// ends it; null if none was seen.
Json bump_json(const FoldingView& view);

/// The contract's `fold --json`.
Json folding_json(const FoldingView& view);

/// What is exported of a sheet (candidate.schema.json): metrics and elongations are null for one
/// that deploys from nothing.
Json folded_pattern_json(const Sampling& sampling, const FoldingView& view,
                         const std::optional<solver::Metrics>& metrics, const Json& actuation,
                         const Json& deployment);

/// What a candidate's export says besides: {"campaign": {"name", "identity"}, "draw", "yields"},
/// the last as from yields_json. With a certificate also that ("certificate", certificate_json).
Json origin_json(const Campaign& campaign, std::uint64_t draw, const Json& yields);

}  // namespace misalign::schema
