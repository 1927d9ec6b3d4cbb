#include "schema/campaign/stop_rule.hpp"

#include "schema/campaign/splitting.hpp"
#include "schema/files/json_values.hpp"

namespace misalign::schema {

// Reads a key that may be null for "no limit".
void read_stop(ObjectReader reader, StopRule& stop) {
  const auto whole = [&](const char* key, std::optional<std::uint64_t>& into, std::uint64_t most) {
    const Json* value = reader.find(key);
    if (!value) return;
    into.reset();
    if (!value->is_null()) {
      reader.whole(key, into.emplace(0), most, "write a count, or null for no limit");
    }
  };
  whole("draws", stop.draws, kEndOfDraws);
  whole("populations", stop.populations, kEndOfPopulations);
  whole("accepted", stop.accepted, kEndOfDraws);
  reader.number("relative_error", stop.relative_error, 1e-6, 1,
                "write a share of the rate like 0.05, or null for no limit");
  reader.number("wall_s", stop.wall_s, 0, 1e9, "write seconds, or null for no limit");
  reader.refuse_unknown_keys();
}

Json stop_json(const StopRule& stop) {
  return {{"draws", or_null(stop.draws)},
          {"populations", or_null(stop.populations)},
          {"accepted", or_null(stop.accepted)},
          {"relative_error", or_null(stop.relative_error)},
          {"wall_s", or_null(stop.wall_s)}};
}

}  // namespace misalign::schema
