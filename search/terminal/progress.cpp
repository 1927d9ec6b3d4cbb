#include "search/terminal/progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <string>

#include "search/terminal/screen.hpp"

namespace misalign::search {
namespace {

double first_s(ProgressStyle style) {
  switch (style) {
    case ProgressStyle::bar:
      return 0.2;
    case ProgressStyle::json:
      return 2;
    default:
      return 10;
  }
}

double every_s(ProgressStyle style) { return style == ProgressStyle::plain ? 30 : first_s(style); }

}  // namespace

Progress::Progress(ProgressStyle style) : style_(style), next_s_(first_s(style)) {}

ProgressReport Progress::report(const ProgressCounts& counts) {
  const double elapsed_s = seconds();
  speed_.see(elapsed_s, counts.draws_of_run);
  return {counts, elapsed_s, speed_.draws_per_s(),
          elapsed_s > 0 ? static_cast<double>(counts.draws_of_run) / elapsed_s : 0, false};
}

void Progress::print(const ProgressReport& report) {
  switch (style_) {
    case ProgressStyle::bar:
      draw_live_line(bar_line(report, terminal_width(STDERR_FILENO) - 1));
      break;
    case ProgressStyle::json:
      std::fprintf(stderr, "%s\n", json_line(report).c_str());
      break;
    case ProgressStyle::automatic:
    case ProgressStyle::plain:
      std::fprintf(stderr, "%s\n", plain_line(report).c_str());
      break;
    case ProgressStyle::none:
      break;
  }
}

void Progress::show(const ProgressCounts& counts) {
  if (!due()) return;
  next_s_ = seconds() + every_s(style_);
  print(report(counts));
}

void Progress::show_status(const ProgressCounts& counts) {
  erase_live_line();
  const ProgressReport now = report(counts);
  const bool json = style_ == ProgressStyle::json;
  std::fprintf(stderr, "%s\n", (json ? json_line(now) : plain_line(now)).c_str());
}

void Progress::finish(const ProgressCounts& counts) {
  ProgressReport last = report(counts);
  last.last = true;
  print(last);
  leave_live_line();
}

}  // namespace misalign::search
