// Shows the progress of a search on standard error: in one live line, in a line now and then, or as
// JSON.
#pragma once

#include "search/terminal/progress_text.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {

class Progress {
 public:
  /// Not `automatic`: see resolved().
  explicit Progress(ProgressStyle style);
  /// Whether show() would print; before that what it prints need not be counted.
  bool due() const { return style_ != ProgressStyle::none && seconds() >= next_s_; }
  /// A line of the style. Not more often than it is due.
  void show(const ProgressCounts& counts);
  /// A line that was asked for: even where the style is none, and JSON where it is that.
  void show_status(const ProgressCounts& counts);
  /// The last line.
  void finish(const ProgressCounts& counts);
  double seconds() const { return watch_.seconds(); }

 private:
  ProgressReport report(const ProgressCounts& counts);
  void print(const ProgressReport& report);

  ProgressStyle style_;
  Stopwatch watch_;
  RecentSpeed speed_;
  double next_s_;
};

}  // namespace misalign::search
