// The log of a disk: every change of its files and names in their order, as bytes that outlive the
// process that made them.
#pragma once

#include <cstring>
#include <string_view>

#include "tests/simulation/disk.hpp"

namespace misalign::simulation {

struct LogEntry {
  enum Kind { create, name, write, truncate, sync, fail_sync, remove, rename, sync_names };
  Kind kind;
  std::uint64_t file, at;      ///< a truncation's size
  std::string_view bytes, to;  ///< written bytes, or a name; the new name
};

class DiskLog {
 public:
  explicit DiskLog(DiskState& state) : state_(state) {}

  void create(std::uint64_t file, std::string_view its_name) {
    add({LogEntry::create, file, 0, its_name, {}});
  }
  void name(std::uint64_t file, std::string_view its_name) {
    add({LogEntry::name, file, 0, its_name, {}});
  }
  void write(std::uint64_t file, std::uint64_t at, std::string_view bytes) {
    add({LogEntry::write, file, at, bytes, {}});
  }
  void truncate(std::uint64_t file, std::uint64_t size) {
    add({LogEntry::truncate, file, size, {}, {}});
  }
  void sync(std::uint64_t file) { add({LogEntry::sync, file, 0, {}, {}}); }
  void fail_sync(std::uint64_t file) { add({LogEntry::fail_sync, file, 0, {}, {}}); }
  void remove(std::string_view its_name) { add({LogEntry::remove, 0, 0, its_name, {}}); }
  void rename(std::string_view from, std::string_view to) {
    add({LogEntry::rename, 0, 0, from, to});
  }
  void sync_names() { add({LogEntry::sync_names, 0, 0, {}, {}}); }

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
  void add(const LogEntry& entry) {
    const std::uint64_t size = sizeof entry + entry.bytes.size() + entry.to.size();
    if (state_.log_size + size > DiskState::kLog_bytes) std::abort();
    char* const at = state_.log + state_.log_size;
    std::memcpy(at, &entry, sizeof entry);
    std::memcpy(at + sizeof entry, entry.bytes.data(), entry.bytes.size());
    std::memcpy(at + sizeof entry + entry.bytes.size(), entry.to.data(), entry.to.size());
    state_.log_size += size;
  }

  DiskState& state_;
};

}  // namespace misalign::simulation
