// The stop rule: when a campaign or a run is over.
#pragma once

#include <cstdint>
#include <optional>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// When a campaign or a run is over; what is absent does not limit.
struct StopRule {
  std::optional<std::uint64_t> draws = 1000000;
  std::optional<std::uint64_t> populations = 100;  ///< of a splitting search, instead of draws
  std::optional<std::uint64_t> accepted;           ///< of a splitting search: that are kept at most
  std::optional<double> relative_error;            ///< of the acceptance rate, see Goal
  std::optional<double> wall_s;
};

/// Reads the part "stop" of a campaign.
void read_stop(ObjectReader reader, StopRule& stop);

/// Every key of that part.
Json stop_json(const StopRule& stop);

}  // namespace misalign::schema
