#include "search/terminal/duration.hpp"

#include <cstdio>

namespace misalign::search {

std::string duration(double seconds) {
  char text[64];
  constexpr long long kMinute_s = 60, kHour_s = 3600, kDay_s = 86400, kYear_s = 365 * kDay_s;
  if (!(seconds < 1e13)) return "ages";
  const auto s = static_cast<long long>(seconds);
  if (s >= 2 * kYear_s) {
    std::snprintf(text, sizeof text, "%lld years", s / kYear_s);
  } else if (s >= kDay_s) {
    std::snprintf(text, sizeof text, "%lld d %lld h", s / kDay_s, s % kDay_s / kHour_s);
  } else if (s >= kHour_s) {
    std::snprintf(text, sizeof text, "%lld h %lld min", s / kHour_s, s % kHour_s / kMinute_s);
  } else if (s >= kMinute_s) {
    std::snprintf(text, sizeof text, "%lld min %lld s", s / kMinute_s, s % kMinute_s);
  } else {
    std::snprintf(text, sizeof text, "%lld s", s);
  }
  return text;
}

}  // namespace misalign::search
