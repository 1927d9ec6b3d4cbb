// Says on standard error how far it is with what takes long: by a thread, since not every work
// comes by to say so.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "search/terminal/progress_text.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {

/// What is known of a work under way.
struct WorkState {
  std::string what;           ///< what is counted: "sheets written"; or the whole, in words
  std::uint64_t done = 0;     ///< of them; 0 of 0: nothing is counted
  std::uint64_t all = 0;      ///< 0: nobody knows
  double elapsed_s = 0;       ///< of the whole work
  double what_elapsed_s = 0;  ///< since this was begun
};

/// "12 s: 40 of 1000 sheets written, 4 min 48 s left", "12 s: 40 sheets let go", "12 s: contact".
std::string work_line(const WorkState& state);

/// While it lives, from the first five seconds on: a live line on a terminal, elsewhere a line, and
/// another one every half a minute. One at a time.
class LongWork {
 public:
  /// `name`: what is under way as long as nothing is counted. `style`: bar, plain or none. With
  /// `all` a line at once whenever something else is counted, and of where it ended.
  LongWork(std::string name, ProgressStyle style, bool all);
  ~LongWork();
  LongWork(const LongWork&) = delete;
  LongWork& operator=(const LongWork&) = delete;

  void see(const std::string& what, std::uint64_t done, std::uint64_t of);
  /// Nothing more is said: somebody reads what comes out.
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

/// Automatic, but none where the log is to say no more than warnings.
ProgressStyle work_style(bool under_launcher = false);

/// What the LongWork that lives, if there is one, is to say: so many of `of` (0: nobody knows how
/// many), or `what` alone.
void show_work(const std::string& what, std::uint64_t done = 0, std::uint64_t of = 0);
/// Ends what it says.
void end_shown_work();

}  // namespace misalign::search
