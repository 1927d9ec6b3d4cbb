// Replays a disk's log up to a power cut: a file is what was synced of it, and any part of what was
// written since.
#include <algorithm>
#include <array>
#include <map>

#include "tests/simulation/disk_log.hpp"

namespace misalign::simulation {
namespace {

struct Change {
  bool is_truncation;
  std::uint64_t at;  // or the new size
  std::string_view bytes;
};

// A file's bytes that are on the disk, and what waits to be written.
struct StoredFile {
  std::string bytes;
  std::vector<Change> waiting;
};

void put(std::string& bytes, std::uint64_t at, std::string_view written) {
  bytes.resize(std::max<std::size_t>(bytes.size(), at + written.size()));
  bytes.replace(at, written.size(), written);
}

class Survivors {
 public:
  explicit Survivors(Random& random) : random_(random), names_follow_(happens(random, 0.5)) {}

  void replay(const LogEntry& entry) {
    switch (entry.kind) {
      case LogEntry::name:
      case LogEntry::remove:
      case LogEntry::rename:
        waiting_names_.push_back(entry);
        break;
      case LogEntry::write:
        files_[entry.file].waiting.push_back({false, entry.at, entry.bytes});
        break;
      case LogEntry::truncate:
        files_[entry.file].waiting.push_back({true, entry.at, {}});
        break;
      case LogEntry::sync:
        write_all(files_[entry.file]);
        if (names_follow_) write_name(entry.file);
        break;
      case LogEntry::fail_sync:
        // The system took bytes that it could not write for written; a size it keeps in its
        // journal.
        std::erase_if(files_[entry.file].waiting, [&](const Change& change) {
          return !change.is_truncation && happens(random_, 0.5);
        });
        break;
      case LogEntry::sync_names:
        for (const LogEntry& name : waiting_names_) apply(name);
        waiting_names_.clear();
        break;
    }
  }

  /// The files by their names after a power cut.
  std::map<std::string, std::string> cut() {
    const std::size_t names_left = up_to(random_, waiting_names_.size() + 1);
    for (std::size_t k = 0; k < names_left; ++k) apply(waiting_names_[k]);
    const std::size_t sector = happens(random_, 0.5) ? 512 : 4096;
    const double survives = std::array{0.0, 0.1, 0.5, 0.9, 1.0}[up_to(random_, 5)];
    std::map<std::string, std::string> left;
    for (const auto& [name, number] : names_) {
      StoredFile file = files_[number];
      for (const Change& change : file.waiting) apply_some(file.bytes, change, sector, survives);
      left[name] = std::move(file.bytes);
    }
    return left;
  }

 private:
  static void write_all(StoredFile& file) {
    for (const Change& change : file.waiting) {
      change.is_truncation ? file.bytes.resize(change.at)
                           : put(file.bytes, change.at, change.bytes);
    }
    file.waiting.clear();
  }

  // A torn write: each of its sectors is new or old.
  void apply_some(std::string& bytes, const Change& change, std::size_t sector, double survives) {
    if (change.is_truncation) {
      if (happens(random_, survives)) bytes.resize(change.at);
      return;
    }
    for (std::size_t done = 0; done < change.bytes.size();) {
      const std::uint64_t at = change.at + done;
      const std::size_t size = std::min(sector - at % sector, change.bytes.size() - done);
      if (happens(random_, survives)) put(bytes, at, change.bytes.substr(done, size));
      done += size;
    }
  }

  void write_name(std::uint64_t file) {
    const auto at = std::ranges::find_if(waiting_names_, [&](const LogEntry& entry) {
      return entry.kind == LogEntry::name && entry.file == file;
    });
    if (at == waiting_names_.end()) return;
    for (auto name = waiting_names_.begin(); name <= at; ++name) apply(*name);
    waiting_names_.erase(waiting_names_.begin(), at + 1);
  }

  void apply(const LogEntry& entry) {
    const std::string name(entry.bytes);
    if (entry.kind == LogEntry::remove) {
      names_.erase(name);
    } else if (entry.kind == LogEntry::rename) {
      names_[std::string(entry.to)] = names_[name];
      names_.erase(name);
    } else {
      names_[name] = entry.file;
    }
  }

  Random& random_;
  const bool names_follow_;  // whether the file system syncs a new file's name with the file
  std::map<std::uint64_t, StoredFile> files_;
  std::map<std::string, std::uint64_t> names_;
  std::vector<LogEntry> waiting_names_;
};

}  // namespace

void Disk::lose_power(Random& random) {
  Survivors survivors(random);
  DiskLog(*state_).each([&](const LogEntry& entry) { survivors.replay(entry); });
  const auto files = survivors.cut();
  clear();
  for (const auto& [name, bytes] : files) {
    if (name.ends_with("-shm") && happens(random, 0.5)) continue;  // never written to this disk
    put(name, bytes);
  }
}

}  // namespace misalign::simulation
