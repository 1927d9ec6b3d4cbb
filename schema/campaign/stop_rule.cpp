#include "schema/campaign/stop_rule.hpp"

#include "schema/campaign/splitting.hpp"
#include "schema/files/json_values.hpp"

namespace misalign::schema {

// A key that may be null for "no limit".
void read_stop(ObjectReader reader, StopRule& stop) {
  const auto limit = [&](const char* key, auto& into, auto read) {
    const Json* value = reader.find(key);
    if (!value) return;
    into.reset();
    if (!value->is_null()) into = read(key);
  };
  const auto whole = [&](const char* key) {
    std::uint64_t n = 0;
    reader.whole(key, n, kEndOfDraws, "write a count, or null for no limit");
    return n;
  };
  limit("draws", stop.draws, whole);
  limit("populations", stop.populations, [&](const char* key) {
    std::uint64_t n = 0;
    reader.whole(key, n, kEndOfPopulations, "write a count, or null for no limit");
    return n;
  });
  limit("accepted", stop.accepted, whole);
  limit("relative_error", stop.relative_error, [&](const char* key) {
    double error = 0;
    reader.number(key, error, 1e-6, 1, "write a share of the rate like 0.05, or null for no limit");
    return error;
  });
  limit("wall_s", stop.wall_s, [&](const char* key) {
    double seconds = 0;
    reader.number(key, seconds, 0, 1e9, "write seconds, or null for no limit");
    return seconds;
  });
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
