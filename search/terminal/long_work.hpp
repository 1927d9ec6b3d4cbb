// Shows the progress of long work on standard error, from a thread of its own.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "search/terminal/progress_text.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {

/// The progress of work under way.
struct WorkState {
  std::string what;           ///< things counted, such as "sheets written"; else the work's name
  std::uint64_t done = 0;     ///< count so far; 0 of 0: nothing is counted
  std::uint64_t all = 0;      ///< total; 0: unknown
  double elapsed_s = 0;       ///< since the work began
  double what_elapsed_s = 0;  ///< since this count began
};

/// "12 s: 40 of 1000 sheets written, 4 min 48 s left", "12 s: 40 sheets released", "12 s: contact".
std::string work_line(const WorkState& state);

/// Shows progress during its life, after the first five seconds: a live line on a terminal,
/// elsewhere a line every half a minute. One object at a time.
class LongWork {
 public:
  /// `name` is shown as long as nothing is counted. `style`: bar, plain or none. With `all` every
  /// change of what is counted, and the end, get a line at once.
  LongWork(std::string name, ProgressStyle style, bool all);
  ~LongWork();
  LongWork(const LongWork&) = delete;
  LongWork& operator=(const LongWork&) = delete;

  void see(const std::string& what, std::uint64_t done, std::uint64_t all);
  /// Ends the output: the reader sees the results themselves now.
  void end();

 private:
  void watch();
  void print();

  const ProgressStyle style_;
  const bool all_;
  Stopwatch watch_;
  std::mutex mutex_;
  std::condition_variable ends_;
  WorkState state_;
  double what_begun_s_ = 0;
  bool has_ended_ = false;
  std::thread thread_;
};

/// Returns automatic, or none if the log level is above info.
ProgressStyle work_style(bool under_launcher = false);

/// Reports to the living LongWork, if there is one: `done` of `all` (0: unknown), or `what` alone.
void show_work(const std::string& what, std::uint64_t done = 0, std::uint64_t all = 0);
/// Ends its output.
void end_shown_work();

}  // namespace misalign::search
