#include "tests/bench/scale/large_ledger.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>

#include "schema/catalogue/catalogue.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "search/draws/ledger.hpp"
#include "search/terminal/stopwatch.hpp"
#include "tests/bench/scale/invented_draws.hpp"

namespace misalign::bench {
namespace {

using search::Stopwatch;

void remove_catalogue(const std::string& path) {
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
    std::filesystem::remove(path + suffix);
  }
}

// A line of /proc/self/status, in MB.
double memory_mb(const std::string& name) {
  std::ifstream lines("/proc/self/status");
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(name + ":", 0) == 0) return std::stod(line.substr(name.size() + 1)) / 1024;
  }
  return 0;
}

// How much resident memory grows at most while it lives.
class MemoryWatch {
 public:
  MemoryWatch() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak starts again from here
    before_mb_ = memory_mb("VmRSS");
  }
  double grown_mb() const { return memory_mb("VmHWM") - before_mb_; }

 private:
  double before_mb_;
};

// Rows by SQL alone: the units' trigger, which would look each of them up, is made anew afterwards.
void fill(const std::string& path, const LedgerSize& size) {
  SQLite::Database database(path, SQLite::OPEN_READWRITE);
  database.exec("PRAGMA synchronous = OFF; PRAGMA journal_mode = OFF; PRAGMA cache_size = -200000");
  const std::string trigger =
      database.execAndGet("SELECT sql FROM sqlite_schema WHERE name = 'unit_overlaps'").getString();
  database.exec("BEGIN; DROP TRIGGER unit_overlaps");
  SQLite::Statement units(
      database,
      "WITH RECURSIVE count (k) AS (SELECT 0 UNION ALL SELECT k + 1 FROM count WHERE k + 1 < "
      ":units) INSERT INTO unit SELECT k * :draws, (k + 1) * :draws, 1, k % 10000 + 1, 0, :draws, "
      "0, 5.0, zeroblob(16) FROM count WHERE k = 0 OR abs(random() % 1000000) >= :missing");
  units.bind(":units", schema::stored(size.draws / size.unit_draws));
  units.bind(":draws", schema::stored(size.unit_draws));
  units.bind(":missing", static_cast<std::int64_t>(size.missing * 1e6));
  units.exec();
  database.exec(trigger);
  if (size.sampled > 0) {
    SQLite::Statement sampled(
        database,
        "WITH RECURSIVE count (k) AS (SELECT 0 UNION ALL SELECT k + 1 FROM count WHERE k + 1 < "
        ":rows) INSERT INTO fault_sample (draw, unit, deploys_from_sample, "
        "first_fault, fault_deg, \"where\") SELECT k * 1024, k * 1024 / :draws * :draws, k * 7 % "
        "170, "
        "iif(k % 200, 'not_monotone', 'fold_limit'), k * 7 % 170 + 1.0, iif(k % 200, 'A18-A10', "
        "NULL) FROM count");
    sampled.bind(":rows", schema::stored(size.sampled));
    sampled.bind(":draws", schema::stored(size.unit_draws));
    sampled.exec();
  }
  database.exec("COMMIT");
}

// Nothing of the file is in the system's memory afterwards.
void forget(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY);
  ::fsync(file);
  ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
  ::close(file);
}

}  // namespace

LedgerTimes time_large_ledger(const std::string& folder, const LedgerSize& size) {
  const std::string path = folder + "/scale_ledger.db";
  remove_catalogue(path);
  const InventedDraws draws(1);
  const schema::Goal goal{{0, schema::kEndOfDraws}, size.draws, {}, {}};
  {
    schema::Catalogue fresh(path, draws.campaign(), draws.mechanism());
    fresh.begin_run(invented_run(2), goal);
    fresh.end_run("stopped");
  }
  fill(path, size);

  LedgerTimes times{};
  times.bytes = std::filesystem::file_size(path);
  {
    const MemoryWatch memory;
    std::optional<schema::Catalogue> catalogue;
    const auto timed = [](const auto& work) {
      const Stopwatch watch;
      work();
      return watch.seconds();
    };
    std::vector<schema::DrawRange> done;
    std::optional<search::Ledger> ledger;
    times.open_s = timed([&] { catalogue.emplace(path, draws.campaign(), draws.mechanism()); });
    times.begin_run_s = timed([&] { catalogue->begin_run(invented_run(2), goal); });
    times.done_s = timed([&] { done = catalogue->done(); });
    times.ledger_s = timed([&] {
      ledger.emplace(schema::DrawRange{0, catalogue->goal_end()}, done);
    });
    times.resume_mb = memory.grown_mb();
    times.units = done.size();
    while (ledger->take(size.unit_draws)) ++times.gaps;
    catalogue->end_run("stopped");
  }
  forget(path);
  const auto status_s = [&] {
    const Stopwatch watch;
    schema::read_state(*schema::open_for_reading(path));
    return watch.seconds();
  };
  const MemoryWatch memory;
  times.status_with_file_uncached_s = status_s();
  times.status_mb = memory.grown_mb();
  times.status_s = status_s();
  remove_catalogue(path);
  return times;
}

}  // namespace misalign::bench
