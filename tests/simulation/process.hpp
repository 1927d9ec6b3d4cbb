// Processes on the simulated machine and disk: each is forked, runs a program in virtual time, and
// stands still where its caller shall look.
#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/simulation/disk.hpp"

namespace misalign::simulation {

/// The phases in which calls of the file system are counted.
enum class Work { unit, piece, ascent, certificate, migration, merge, file, yield };
inline constexpr const char* kWorkNames[] = {"unit",      "piece", "ascent", "certificate",
                                             "migration", "merge", "file",   "yield"};
inline constexpr int kWorks = 8;

struct Life {
  std::function<int(int rank)> program;  ///< see run_job
  int ranks = 1;
  std::uint64_t seed = 0;
  Work work = Work::unit;
  std::vector<Fault> faults = {};
  std::vector<Happening> happenings = {};
  bool is_visit = false;  ///< true: its calls are not counted, and never fail
};

/// The end of a process.
struct LifeEnd {
  bool by_signal = false;
  int code = 0;  ///< exit code, or signal
  bool lost_power = false;
  bool was_cut = false;      ///< a kill or power cut at a call has ended it
  std::uint64_t calls = 0;   ///< number of its file calls
  std::uint64_t errors = 0;  ///< calls that failed
  std::uint64_t draws_made = 0;
  double stop_s = 0;  ///< virtual time from the first request to stop to the end
  std::string out, err;

  bool was_killed() const;
};

class Process {
 public:
  Process(Disk& disk, const Life& life);
  /// Kills it, if it still runs.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Lets it run on until it stands still, and returns the number of that visit; none once it has
  /// ended.
  std::optional<int> run_on();
  const LifeEnd& end() const { return end_; }

 private:
  Disk& disk_;
  pid_t id_ = 0;
  int from_ = -1, to_ = -1;  // pipes
  int out_ = -1, err_ = -1;  // what it prints
  bool stands_still_ = false;
  LifeEnd end_;
};

/// Stands still, within a process, until its caller lets it run on.
void stand_still(int visit);

/// A process within another's life.
Life visit(std::function<int(int)> program);

/// Returns "unit: 2 ranks, kill at call 7 ...; exit 0 ..." and what it has printed.
std::string told_life(const Life& life, const LifeEnd& end);

/// Runs a process to its end, without looking.
LifeEnd run_through(Disk& disk, const Life& life);

}  // namespace misalign::simulation
