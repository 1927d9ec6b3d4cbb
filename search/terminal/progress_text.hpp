// Writes the progress of a search as a line for people or as JSON, from counts alone.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "schema/catalogue/catalogue.hpp"

namespace misalign::search {

enum class ProgressStyle { automatic, plain, bar, json, none };

/// Resolves `automatic`: a bar on a terminal, but not under mpirun, where every rank sees a
/// terminal even if the output goes to a file.
ProgressStyle resolved(ProgressStyle style, bool able_terminal, bool under_launcher);

struct ProgressCounts {
  schema::Standing standing;       ///< totals of the campaign, with earlier runs
  std::uint64_t draws_of_run = 0;  ///< draws of this run alone
  std::uint64_t draws_left = 0;
  bool limited = false;                ///< true if draws_left has a meaning
  std::optional<double> max_time_s{};  ///< limit of this run's wall time
  const char* of = "draws";            ///< things counted: draws, populations, certificates
  std::string under_way{};             ///< the step under way, in words
};

/// Contents of a progress line.
struct ProgressReport {
  ProgressCounts counts;
  double elapsed_s = 0;
  double draws_per_s = 0;       ///< recent speed
  double draws_per_s_mean = 0;  ///< mean speed of this run
  bool last = false;
};

std::string plain_line(const ProgressReport& report);
/// Writes at most `width` columns; the least important parts are left out first.
std::string bar_line(const ProgressReport& report, int width);
std::string json_line(const ProgressReport& report);

/// Writes three significant digits: 999, 12.3 k, 4.56 M.
std::string short_number(double value);

/// Measures draws per second over the last 15 s, or since the start: ranks send their draws every 5
/// s.
class RecentSpeed {
 public:
  void see(double elapsed_s, std::uint64_t draws);
  double draws_per_s() const;

 private:
  struct Point {
    double elapsed_s;
    std::uint64_t draws;
  };
  std::deque<Point> points_{{0, 0}};
};

}  // namespace misalign::search
