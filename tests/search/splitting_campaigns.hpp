// Campaigns that several tests of splitting climb.
#pragma once

#include "schema/campaign/campaign_file.hpp"
#include "solver/lanes/batch.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::search {

using solver::kFewer;

inline constexpr std::uint64_t kClimbSeed = 20150235;

/// A 4 x 4 Miura-ori, two moves a level; keys of "misalignment" where they are no defaults.
inline schema::Campaign climbed_miura(double threshold_deg, std::uint64_t seed = kClimbSeed,
                                      const schema::Json& misalignment = schema::Json::object()) {
  return schema::read_campaign({{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                                {"misalignment", misalignment},
                                {"accept", {{"deploys_from_deg", threshold_deg}}},
                                {"search", {{"method", "splitting"}, {"sweeps", 2u}}},
                                {"seed", seed}},
                               "a test");
}

inline solver::InstructionSet widest_set() { return solver::available_instruction_sets().back(); }

}  // namespace misalign::search
