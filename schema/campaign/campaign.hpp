// A campaign: which sheets are drawn, how their paths are followed, which draws are accepted, and
// when to stop.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "schema/campaign/draw_range.hpp"
#include "schema/campaign/pattern_file.hpp"
#include "schema/campaign/splitting.hpp"
#include "schema/campaign/stop_rule.hpp"
#include "solver/design/actuators.hpp"

namespace misalign::schema {

enum class ShiftDistribution {
  ternary,  ///< -a, 0, +a
  uniform   ///< on [-a, +a]
};

/// How the vertices are shifted.
struct Misalignment {
  std::vector<int> vertices;  ///< ascending
  double amplitude_mm = 0.4;
  ShiftDistribution distribution = ShiftDistribution::ternary;
};

/// A stop on the way: springs that are relaxed at this pilot angle hold the sheet there.
struct RequiredStop {
  double at_deg;
  double least_mm2_per_rad2;  ///< of solver::stop_stiffness; times a spring's k: N mm/rad

  bool operator==(const RequiredStop&) const = default;
};

/// The member initializers are the released defaults: they never change (identity leaves them out).
struct Campaign {
  std::string name = "miura-6x6";
  Pattern pattern;
  Misalignment misalignment;
  double sample_deg = 1;
  double end_deg = 180;
  double threshold_deg = 170;
  solver::BumpRule between_samples = solver::BumpRule::ignored;
  std::optional<RequiredStop> required_stop;  ///< not beyond the threshold
  std::optional<Splitting> splitting;         ///< nothing: plain draws
  std::uint64_t seed = 1;
  StopRule stop;
  solver::Actuators actuators;  ///< outside the identity: what is shown of candidates
  /// Whether the search makes each candidate's certificate as it goes; outside the identity.
  bool certify = false;

  /// The least D that is accepted.
  int threshold_sample() const;
  /// Whether a draw with this verdict is kept.
  bool accepts(const solver::Verdict& verdict) const;
  /// What is asked besides.
  solver::Criterion criterion() const;
  Sampling sampling() const { return {sample_deg, end_deg, between_samples}; }
  solver::PathPlanOptions path() const { return {sample_deg, end_deg}; }
};

/// Reads and checks a campaign; UserError (bad_input) naming `source` with every fault. A FOLD file
/// that its pattern names is looked for in `directory`; without one none may be named.
Campaign read_campaign(const Json& value, const std::string& source,
                       const std::optional<std::filesystem::path>& directory = {});
Campaign read_campaign_file(const std::string& path);

/// The bounds of a stiffness and of a stroke limit, here and on the command line.
inline constexpr double kLeastStiffness_n_per_mm = 1e-6, kMostStiffness_n_per_mm = 1e9;
inline constexpr double kLeastStroke = 1e-6, kMostStroke = 1;

/// The default campaign: the paper's.
Campaign default_campaign();

/// The resolved configuration, every key. Reading it again gives the same campaign.
Json campaign_json(const Campaign& campaign);

/// The same without what older programs do not know, where that is the default:
/// what a catalogue keeps, so that they can still read it.
Json stored_configuration(const Campaign& campaign);

/// What the identity is made of: pattern, misalignment, path, accept and seed, keys at their
/// defaults left out.
Json identity_json(const Campaign& campaign);

/// XXH3-128 of identity_json, sorted keys, no spaces: 32 hex digits.
std::string identity(const Campaign& campaign);

/// "/seed (1 there, 2 here)", for every key of the identity in which two campaigns differ.
std::string differences(const Campaign& there, const Campaign& here);

}  // namespace misalign::schema
