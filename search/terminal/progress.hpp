// Shows the progress of a search on standard error: a live line, a line now and then, or JSON.
#pragma once

#include "search/terminal/progress_text.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {

class Progress {
 public:
  /// `style` is not `automatic`: see resolved().
  explicit Progress(ProgressStyle style);
  /// Returns whether show() would print; the counts are not needed before.
  bool due() const { return style_ != ProgressStyle::none && seconds() >= next_s_; }
  /// Prints a line of the style, if it is due.
  void show(const ProgressCounts& counts);
  /// Prints a requested line: JSON if that is the style, otherwise plain, even for none.
  void show_status(const ProgressCounts& counts);
  /// Prints the last line.
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
