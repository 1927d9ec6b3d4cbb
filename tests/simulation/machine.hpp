// A machine of virtual time: ranks and their threads take turns in one process, and whoever sleeps
// or computes lets the clock go on. machine.cpp puts itself in place of the C library's clocks,
// sleeps and threads, messages.cpp in place of MPI: the program above them is the real one.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

namespace misalign::simulation {

using Nanoseconds = std::int64_t;
inline constexpr Nanoseconds kSecond = 1'000'000'000, kMillisecond = 1'000'000;

using Random = std::mt19937_64;
/// Returns a number from 0 to `below` - 1, or whether something of that probability happens.
inline std::uint64_t up_to(Random& random, std::uint64_t below) { return random() % below; }
inline bool happens(Random& random, double probability) {
  return static_cast<double>(random() >> 11) * 0x1p-53 < probability;
}

/// An act of the machine upon a job.
struct Happening {
  enum Kind {
    signal,    ///< a signal to all ranks; mpirun's SIGTERM and SIGINT are followed by SIGKILL
    silence,   ///< a rank answers no more
    pause_job  ///< the job stands still while somebody else looks, see Job::stand_still
  };
  Nanoseconds at;
  Kind kind;
  int number = 0;  ///< the signal, the rank, or the visit
};

/// A job of some ranks on this machine.
struct Job {
  int ranks = 1;
  std::uint64_t seed = 0;
  std::function<int(int rank)> run;            ///< a rank's program; returns its exit code
  std::vector<Happening> happenings;           ///< ascending
  std::function<void(int visit)> stand_still;  ///< called at a visit
  std::function<void(Nanoseconds)> is_asked, has_ended;  ///< called at a signal, and at the end
};

/// Runs a job in this process, which it ends with the exit code that mpirun, or the program alone,
/// would have.
[[noreturn]] void run_job(const Job& job);

/// Returns whether a job runs in this process; the rest is for those within it.
bool is_running();
int rank_here();
int ranks_here();
Nanoseconds now();
void compute(Nanoseconds duration);
/// Lets the clock go on without a change of turn, as a call of the file system does.
void pass(Nanoseconds duration);
Random& machine_random();
/// Ends the job at once.
[[noreturn]] void end_job(int exit_code);

}  // namespace misalign::simulation
