// Writes a folding path as JSON, for `fold`, `replay` and `export`.
#pragma once

#include "schema/catalogue/candidate_row.hpp"
#include "solver/fill/fill.hpp"
#include "solver/sheet/held_rest.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// A sheet and its history as such files show them.
struct FoldingView {
  FoldingView(const Pattern& pattern, const solver::Sheet& shown)
      : FoldingView(pattern, shown, shown.history()) {}
  /// A view by another history of the sheet.
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

/// The history's first bump between samples, up to D or as its first fault, {"from_deg", "where"};
/// null if there is none.
Json bump_json(const FoldingView& view);

/// Returns how a filling's energy drives a sheet: {"fill", "deploys_from_deg", "first_fault",
/// "fault_deg", "where", "diagonals_deploy_from_deg", "energy_n_mm" at the samples}; null without a
/// filling that is relaxed flat.
Json energy_json(const FoldingView& view, const solver::Fill& fill);

/// Holding of a sheet at the target of its mesh by a filling that is relaxed there; null for a mesh
/// without a target, a filling that is relaxed elsewhere, or a path that is lost: {"rest_deg",
/// "driven_from_deg", "driven_from_below_deg", "barrier_n_mm", "barrier_deg", "shape_off_mm"}. The
/// last is the largest distance of a vertex from the target, after the best rigid motion.
Json target_json(const FoldingView& view, const solver::Fill& fill);
/// Largest distance of a vertex from the target at its pilot angle, after the best rigid motion;
/// none without a target on the sheet's way.
std::optional<double> off_target_mm(const FoldingView& view);
/// The same as numbers; none as for target_json.
std::optional<solver::HeldRest> held_at_target(const FoldingView& view, const solver::Fill& fill);

/// The JSON of `fold --json`.
Json folding_json(const FoldingView& view);

/// An exported sheet (candidate.schema.json): metrics and elongations are null if it does not
/// deploy from any angle.
Json folded_pattern_json(const Sampling& sampling, const FoldingView& view, const Json& actuation,
                         const Json& deployment);

/// The origin of an exported candidate: {"campaign": {"name", "identity"}, "draw", "yields"}, with
/// yields of yields_json, and its certificate, if it has one ("certificate", certificate_json).
Json origin_json(const Campaign& campaign, std::uint64_t draw, const Json& yields);

}  // namespace misalign::schema
