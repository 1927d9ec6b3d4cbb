// Defines a campaign: the draws, their folding paths, the accepted draws, and when to stop.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "schema/campaign/draw_range.hpp"
#include "schema/campaign/energy_acceptance.hpp"
#include "schema/campaign/misalignment.hpp"
#include "schema/campaign/search_method.hpp"
#include "schema/campaign/stop_rule.hpp"
#include "schema/pattern/design.hpp"
#include "schema/pattern/pattern.hpp"
#include "solver/continuation/path.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::schema {

struct Target;

/// A stop of the folding: springs that are relaxed at this pilot angle hold the sheet there.
struct RequiredStop {
  double at_deg;
  double least_mm2_per_rad2;  ///< least solver::stop_stiffness; times a spring's k: N mm/rad

  bool operator==(const RequiredStop&) const = default;
};

/// A campaign. The member initializers are released defaults and never change (identity leaves them
/// out).
struct Campaign {
  std::string name = "miura-6x6";
  Pattern pattern;
  Misalignment misalignment;
  double sample_deg = 1;
  double end_deg = 180;
  double threshold_deg = 170;
  solver::BumpRule between_samples = solver::BumpRule::ignored;
  std::optional<RequiredStop> required_stop;  ///< not beyond the threshold
  std::optional<EnergyAcceptance> energy;     ///< none: all diagonals must be monotone
  SearchMethod search;
  std::shared_ptr<const Target> target;  ///< shape of SearchMethod::shape, with its angle
  std::uint64_t seed = 1;
  StopRule stop;
  Design design;  ///< requirements of candidates; outside the identity
  /// true if the search makes each candidate's certificate, too; outside the identity.
  bool certify = false;

  /// Returns the least accepted D.
  int threshold_sample() const;
  /// Returns whether a draw with this verdict is accepted.
  bool accepts(const solver::Verdict& verdict) const;
  /// Returns the further requirements of an accepted draw.
  solver::Criterion criterion() const;
  Sampling sampling() const { return {sample_deg, end_deg, between_samples, fill_of(energy)}; }
  solver::PathPlanOptions path() const { return {sample_deg, end_deg}; }
};

/// Adds a fault for each key of a campaign that acceptance by energy excludes.
void check_energy_acceptance(const Campaign& campaign, InputFaults& faults);

}  // namespace misalign::schema
