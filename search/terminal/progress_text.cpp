#include "search/terminal/progress_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "schema/files/input.hpp"
#include "search/terminal/duration.hpp"

namespace misalign::search {

std::string short_number(double value) {
  constexpr std::array<const char*, 7> kUnits = {"", " k", " M", " G", " T", " P", " E"};
  std::size_t unit = 0;
  while (value >= 999.5 && unit + 1 < kUnits.size()) {
    value /= 1000;
    ++unit;
  }
  if (unit == 0) return fmt::format("{:.3g}", value);
  const int digits = value < 9.995 ? 2 : value < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f}{}", value, digits, kUnits[unit]);
}

namespace {

double rate(const ProgressCounts& counts) {
  const auto draws = static_cast<double>(counts.standing.draws);
  return draws > 0 ? static_cast<double>(counts.standing.accepted) / draws : 0;
}

std::uint64_t wanted(const ProgressCounts& counts) {
  return counts.standing.draws + counts.draws_left;
}

std::optional<double> draws_left_s(const ProgressReport& report) {
  if (report.counts.limited && report.counts.draws_left == 0) return 0;
  if (!report.counts.limited || !(report.draws_per_s > 0)) return std::nullopt;
  return static_cast<double>(report.counts.draws_left) / report.draws_per_s;
}

bool is_of_draws(const ProgressCounts& counts) { return counts.of == std::string_view("draws"); }

bool is_of_populations(const ProgressCounts& counts) {
  return counts.of == std::string_view("populations");
}

// The time until the draws are done or the run's time is over, whichever comes first.
std::optional<double> left_s(const ProgressReport& report) {
  const auto draws_s = draws_left_s(report);
  if (!report.counts.max_time_s) return draws_s;
  const double time_s = std::max(*report.counts.max_time_s - report.elapsed_s, 0.0);
  return draws_s ? std::min(*draws_s, time_s) : time_s;
}

std::string speed_or_under_way(const ProgressReport& report) {
  if (!is_of_populations(report.counts))
    return short_number(report.last ? report.draws_per_s_mean : report.draws_per_s) + "/s";
  return report.counts.under_way.empty() ? "between populations" : report.counts.under_way;
}

}  // namespace

ProgressStyle resolved(ProgressStyle style, bool able_terminal, bool under_launcher) {
  if (style != ProgressStyle::automatic) return style;
  return able_terminal && !under_launcher ? ProgressStyle::bar : ProgressStyle::plain;
}

std::string plain_line(const ProgressReport& report) {
  const ProgressCounts& counts = report.counts;
  std::string line = fmt::format("{}: {}", duration(report.elapsed_s), counts.standing.draws);
  if (counts.limited) line += fmt::format(" of {}", wanted(counts));
  if (is_of_draws(counts)) {
    line += fmt::format(" draws, {:.4g} draws/s, {} accepted ({:.4g} %)",
                        report.last ? report.draws_per_s_mean : report.draws_per_s,
                        counts.standing.accepted, 100 * rate(counts));
  } else if (!is_of_populations(counts)) {
    line += fmt::format(" {}, {:.4g}/s", counts.of,
                        report.last ? report.draws_per_s_mean : report.draws_per_s);
  } else {
    line += fmt::format(" {}, {} accepted", counts.of, counts.standing.accepted);
    if (!counts.under_way.empty()) line += ", " + counts.under_way;
  }
  if (const auto& best = counts.standing.best) {
    line += fmt::format(", best {:.10g} deg (draw {})", best->deploys_from_deg, best->draw);
  }
  const auto left = left_s(report);
  if (left && *left > 0) line += ", " + duration(*left) + " left";
  return line;
}

std::string bar_line(const ProgressReport& report, int width) {
  const ProgressCounts& counts = report.counts;
  const auto draws = static_cast<double>(counts.standing.draws);
  std::string done = short_number(draws);
  if (counts.limited) {
    const auto all = static_cast<double>(wanted(counts));
    // The share is rounded down: 100 % means that nothing is left.
    const double percent = all > 0 ? std::floor(100 * draws / all) : 100;
    done += fmt::format(" of {} {} ({:.0f} %)", short_number(all), counts.of, percent);
  } else {
    done += std::string(" ") + counts.of;
  }
  const auto left = left_s(report);
  const std::string time =
      !report.last && left ? duration(*left) + " left" : duration(report.elapsed_s);
  const std::string speed = speed_or_under_way(report);
  if (!is_of_draws(counts) && !is_of_populations(counts)) {
    const std::string line = done + ", " + speed + ", " + time;
    return line.substr(0, static_cast<std::size_t>(std::max(width, 0)));
  }
  const std::string accepted =
      short_number(static_cast<double>(counts.standing.accepted)) + " accepted";
  const std::string share =
      is_of_draws(counts) ? fmt::format(" ({:.3g} %)", 100 * rate(counts)) : "";
  std::string best, best_draw;
  if (counts.standing.best) {
    best = fmt::format(", best {:.10g} deg", counts.standing.best->deploys_from_deg);
    best_draw = fmt::format(" (draw {})", counts.standing.best->draw);
  }
  // The lines are ordered by length, the longest first.
  const std::vector<std::string> lines = {
      done + ", " + speed + ", " + accepted + share + best + best_draw + ", " + time,
      done + ", " + speed + ", " + accepted + share + best + ", " + time,
      done + ", " + speed + ", " + accepted + best + ", " + time,
      done + ", " + speed + ", " + accepted + ", " + time,
      done + ", " + speed + ", " + time,
      done + ", " + time,
      done};
  const auto room = static_cast<std::size_t>(std::max(width, 0));
  for (const std::string& line : lines) {
    if (line.size() <= room) return line;
  }
  return lines.back().substr(0, room);
}

std::string json_line(const ProgressReport& report) {
  const ProgressCounts& counts = report.counts;
  schema::Json best, left;
  if (const auto& found = counts.standing.best) {
    best = {{"deploys_from_deg", found->deploys_from_deg}, {"draw", found->draw}};
  }
  if (const auto seconds = left_s(report)) left = *seconds;
  const std::string noun = counts.of;
  schema::Json line{
      {"elapsed_s", report.elapsed_s},
      {noun, counts.standing.draws},
      {noun + "_left", counts.limited ? schema::Json(counts.draws_left) : schema::Json()},
      {noun + "_per_s", report.draws_per_s},
      {noun + "_per_s_mean", report.draws_per_s_mean},
      {"accepted", counts.standing.accepted},
      {"best", best},
      {"left_s", left},
      {"last", report.last}};
  if (is_of_draws(counts)) {
    line["rate"] = counts.standing.draws > 0 ? schema::Json(rate(counts)) : schema::Json();
  } else {
    line["under_way"] = counts.under_way;
  }
  return line.dump();
}

void RecentSpeed::see(double elapsed_s, std::uint64_t draws) {
  constexpr double kWindow_s = 15, kApart_s = 0.2;
  if (elapsed_s - points_.back().elapsed_s < kApart_s && points_.size() > 1) {
    points_.back() = {std::max(elapsed_s, points_.back().elapsed_s), draws};
  } else {
    points_.push_back({elapsed_s, draws});
  }
  while (points_.size() > 2 && elapsed_s - points_[1].elapsed_s >= kWindow_s) points_.pop_front();
}

double RecentSpeed::draws_per_s() const {
  const double seconds = points_.back().elapsed_s - points_.front().elapsed_s;
  return seconds > 0 ? static_cast<double>(points_.back().draws - points_.front().draws) / seconds
                     : 0;
}

}  // namespace misalign::search
