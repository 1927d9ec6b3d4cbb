// A disk that fails and loses power. disk.cpp puts itself in place of the C library's file calls,
// below SQLite's own VFS and below every other file of the program: the files of a folder lie in
// memory (tmpfs), and a log tells each change apart that was written from what was synced.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/simulation/machine.hpp"

namespace misalign::simulation {

enum class Call { open, read, write, sync, truncate, remove, rename };
inline constexpr const char* kCallNames[] = {"open",     "read",   "write", "sync",
                                             "truncate", "remove", "rename"};
enum class Part { database, journal, log, index, plain, folder };
inline constexpr const char* kPartNames[] = {"database", "journal", "log",
                                             "index",    "plain",   "folder"};
enum class FaultKind {
  io_error,     ///< EIO
  no_space,     ///< ENOSPC
  short_write,  ///< half is written, and said so
  failed_sync,  ///< EIO, after which what was not written counts as written
  kill,         ///< kill -9 before or after the call
  power_cut     ///< the machine goes dark before or after the call
};
inline constexpr const char* kFaultNames[] = {"io_error",    "no_space", "short_write",
                                              "failed_sync", "kill",     "power_cut"};
inline constexpr int kCalls = 7, kParts = 6, kFaults = 6;

/// A fault at the first call that it fits from the `at`-th one of a life on, and at all that fit
/// within the next `lasts` calls.
struct Fault {
  FaultKind kind;
  std::uint64_t at, lasts = 0;
  bool after_call = false;  ///< a kill or power cut comes after the call
  bool is_spent = false;
};

/// Returns whether a fault can happen to a call.
bool fits(FaultKind kind, Call call, Part part);

/// A disk's log and counts, which processes share.
struct DiskState {
  static constexpr std::size_t kLog_bytes = std::size_t{256} << 20;
  std::uint64_t calls;  ///< number in this life
  int work;             ///< phase for `hits`
  std::uint64_t seen[8][kParts][kCalls], hits[8][kParts][kCalls][kFaults];
  std::uint64_t log_size;
  std::uint64_t errors;  ///< faults that calls have reported
  bool has_ended, lost_power;
  Nanoseconds asked_at, ended_at;  ///< times of the first request to stop, and of the end; -1: none
  std::uint64_t draws_made;        ///< number in this life, counted by who makes them
  char log[kLog_bytes];
};

/// The state of this process's disk; null without one.
DiskState* state_here();

/// The disk of a folder. A process, and those that it forks, use one.
class Disk {
 public:
  /// Makes an empty folder, or empties it.
  explicit Disk(std::string folder);
  Disk(const Disk&) = delete;
  Disk& operator=(const Disk&) = delete;

  const std::string& folder() const { return folder_; }
  DiskState& state() { return *state_; }
  /// Makes this the disk of this process, and empties it.
  void use();
  /// Begins anew with an empty folder.
  void clear();
  /// Makes all names durable.
  void sync_names();
  /// Puts a file there, durably.
  void put(const std::string& name, const std::string& bytes);
  /// Lets this process make calls that are not counted, and never fail.
  void visit();
  /// Begins a life, to which these faults happen.
  void begin_life(int work, std::vector<Fault> faults);
  /// Leaves in the folder what survives a power cut: of what was not synced any sectors of 512 or
  /// 4,096 bytes, and of names any that were not synced, in their order.
  void lose_power(Random& random);

 private:
  const std::string folder_;
  DiskState* const state_;
};

}  // namespace misalign::simulation
