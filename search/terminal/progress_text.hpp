// The progress of a search as a line for people or as JSON: from counts alone, without clock or
// file.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "schema/catalogue/catalogue.hpp"

namespace misalign::search {

enum class ProgressStyle { automatic, plain, bar, json, none };

/// What `automatic` means: a bar where somebody watches a terminal. Under mpirun every rank sees
/// one, even when the output goes to a file.
ProgressStyle resolved(ProgressStyle style, bool able_terminal, bool under_launcher);

struct ProgressCounts {
  schema::Standing standing;       ///< of the campaign, earlier runs too
  std::uint64_t draws_of_run = 0;  ///< of this run alone
  std::uint64_t draws_left = 0;
  bool limited = false;                ///< whether draws_left means anything
  std::optional<double> max_time_s{};  ///< that this run may take
  const char* of = "draws";            ///< what is counted: draws, populations, certificates
  std::string under_way{};             ///< what is done of the next, in words
};

/// What one line says.
struct ProgressReport {
  ProgressCounts counts;
  double elapsed_s = 0;
  double draws_per_s = 0;       ///< lately
  double draws_per_s_mean = 0;  ///< of this run
  bool last = false;
};

std::string plain_line(const ProgressReport& report);
/// No wider than `width`; what matters less is left out first.
std::string bar_line(const ProgressReport& report, int width);
std::string json_line(const ProgressReport& report);

/// 999, 12.3 k, 4.56 M: three digits that matter.
std::string short_number(double value);

/// Draws per second over the last 15 s, or as far back as there is something: ranks hand in
/// their draws every 5 s.
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
