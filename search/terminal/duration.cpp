#include "search/terminal/duration.hpp"

#include <fmt/format.h>

namespace misalign::search {

std::string duration(double seconds) {
  constexpr long long kMinute_s = 60, kHour_s = 3600, kDay_s = 86400, kYear_s = 365 * kDay_s;
  if (!(seconds < 1e13)) return "ages";
  const auto s = static_cast<long long>(seconds);
  if (s >= 2 * kYear_s) return fmt::format("{} years", s / kYear_s);
  if (s >= kDay_s) return fmt::format("{} d {} h", s / kDay_s, s % kDay_s / kHour_s);
  if (s >= kHour_s) return fmt::format("{} h {} min", s / kHour_s, s % kHour_s / kMinute_s);
  if (s >= kMinute_s) return fmt::format("{} min {} s", s / kMinute_s, s % kMinute_s);
  return fmt::format("{} s", s);
}

}  // namespace misalign::search
