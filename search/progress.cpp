#include "search/progress.hpp"

#include <cstdio>
#include <string>

namespace misalign::search {
namespace {

std::string duration(double seconds) {
  char text[64];
  const auto s = static_cast<long long>(seconds);
  if (s >= 86400) {
    std::snprintf(text, sizeof text, "%lld d %lld h", s / 86400, s % 86400 / 3600);
  } else if (s >= 3600) {
    std::snprintf(text, sizeof text, "%lld h %lld min", s / 3600, s % 3600 / 60);
  } else if (s >= 60) {
    std::snprintf(text, sizeof text, "%lld min %lld s", s / 60, s % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld s", s);
  }
  return text;
}

}  // namespace

Progress::Progress(ProgressStyle style) : style_(style) {}

void Progress::show(const ProgressCounts& counts, bool now) {
  constexpr double kEvery_s = 30;
  const double elapsed = seconds();
  if (style_ == ProgressStyle::none || (!now && elapsed < next_s_)) return;
  if (elapsed >= next_s_) next_s_ = elapsed + kEvery_s;
  const double draws = static_cast<double>(counts.draws);
  const double speed = elapsed > 0 ? draws / elapsed : 0;
  const double rate = counts.draws > 0 ? static_cast<double>(counts.accepted) / draws : 0;
  std::string left;
  if (counts.limited && speed > 0) {
    left = ", " + duration(static_cast<double>(counts.draws_left) / speed) + " left";
  }
  std::fprintf(stderr, "%s: %llu draws, %.4g draws/s, %llu accepted (%.4g %%)%s\n",
               duration(elapsed).c_str(), static_cast<unsigned long long>(counts.draws), speed,
               static_cast<unsigned long long>(counts.accepted), 100 * rate, left.c_str());
}

}  // namespace misalign::search
