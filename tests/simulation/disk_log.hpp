// The log of a disk: every change of its files and names in their order, as bytes that outlive the
// process that made them.
#pragma once

#include <cstring>
#include <string_view>

#include "tests/simulation/disk.hpp"

namespace misalign::simulation {

struct LogEntry {
  enum Kind { name, write, truncate, sync, fail_sync, remove, rename, sync_names };
  Kind kind;
  std::uint64_t file = 0, at = 0;        ///< a truncation's size
  std::string_view bytes = {}, to = {};  ///< written bytes, or a name; the new name
};

class DiskLog {
 public:
  explicit DiskLog(DiskState& state) : state_(state) {}

  void add(const LogEntry& entry) {
    const std::uint64_t size = sizeof entry + entry.bytes.size() + entry.to.size();
    if (state_.log_size + size > DiskState::kLog_bytes) std::abort();
    char* const at = state_.log + state_.log_size;
    std::memcpy(at, &entry, sizeof entry);
    std::memcpy(at + sizeof entry, entry.bytes.data(), entry.bytes.size());
    std::memcpy(at + sizeof entry + entry.bytes.size(), entry.to.data(), entry.to.size());
    state_.log_size += size;
  }

  /// Calls `look` with each entry.
  template <class Look>
  void each(const Look& look) const {
    for (std::uint64_t at = 0; at < state_.log_size;) {
      LogEntry entry;
      std::memcpy(&entry, state_.log + at, sizeof entry);
      at += sizeof entry;
      entry.bytes = {state_.log + at, entry.bytes.size()};
      at += entry.bytes.size();
      entry.to = {state_.log + at, entry.to.size()};
      at += entry.to.size();
      look(entry);
    }
  }

 private:
  DiskState& state_;
};

}  // namespace misalign::simulation
