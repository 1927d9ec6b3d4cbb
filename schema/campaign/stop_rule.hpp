// Defines the stop rule of a campaign or a run.
#pragma once

#include <cstdint>
#include <optional>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Stopping conditions of a campaign or a run; absent ones do not limit.
struct StopRule {
  std::optional<std::uint64_t> draws = 1000000;
  std::optional<std::uint64_t> populations = 100;  ///< instead of draws in a splitting search
  std::optional<std::uint64_t> accepted;           ///< largest number kept in a splitting search
  std::optional<double> relative_error;            ///< precision of the acceptance rate, see Goal
  std::optional<double> wall_s;
};

/// Reads the part "stop" of a campaign.
void read_stop(ObjectReader reader, StopRule& stop);

/// Returns every key of that part.
Json stop_json(const StopRule& stop);

}  // namespace misalign::schema
