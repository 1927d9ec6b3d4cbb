// A folding path as JSON: what `fold`, `replay` and `export` write.
#pragma once

#include "schema/catalogue/candidate_row.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// What every such file begins with: pattern with these shifts, unknowns, verdict, fold limit.
struct FoldingView {
  FoldingView(const Pattern& pattern, const solver::Sheet& shown)
      : FoldingView(pattern, shown, shown.history()) {}
  /// The same by another history of the sheet.
  FoldingView(const Pattern& pattern, const solver::Sheet& shown,
              const solver::FoldingHistory& another)
      : base(pattern), sheet(shown), history(another) {}

  const Pattern& base;
  const solver::Sheet& sheet;
  const solver::FoldingHistory& history;
  const Eigen::Matrix2Xd& shifts_mm = sheet.shifts_mm();
  const solver::Mechanism& mechanism = sheet.mechanism();
  const double sample_deg = sheet.sample_deg(1);
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
Json folded_pattern_json(const Sampling& sampling, const FoldingView& view, const Json& actuation,
                         const Json& deployment);

/// What a candidate's export says besides: {"campaign": {"name", "identity"}, "draw", "yields"},
/// the last as from yields_json. With a certificate also that ("certificate", certificate_json).
Json origin_json(const Campaign& campaign, std::uint64_t draw, const Json& yields);

}  // namespace misalign::schema
