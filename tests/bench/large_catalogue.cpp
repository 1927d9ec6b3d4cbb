// A catalogue with a million candidates of miura-6x6, written by the program's own commits with
// invented metrics: what the named queries and status take, how large it is, and what its indexes
// cost. CSV on standard output.
#include <sqlite3.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>

#include "schema/catalogue/catalogue.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/result_table.hpp"
#include "schema/files/carried_files.hpp"
#include "schema/records/fault_sample.hpp"
#include "search/terminal/status_text.hpp"
#include "search/terminal/stopwatch.hpp"
#include "tests/bench/scale/invented_draws.hpp"

namespace misalign::bench {
namespace {

using search::Stopwatch;

struct Sizes {
  std::uint64_t candidates = 1000000, sampled = 100000, units = 4000;
};

struct Times {
  double best_ms, median_ms;
};

// Of five calls, after one that fills the caches.
template <class Work>
Times time_five(const Work& work) {
  work();
  std::vector<double> ms;
  for (int k = 0; k < 5; ++k) {
    const Stopwatch watch;
    work();
    ms.push_back(1000 * watch.seconds());
  }
  std::sort(ms.begin(), ms.end());
  return {ms[0], ms[2]};
}

void print(const std::string& what, const Times& times) {
  std::printf("%s,%.2f,%.2f\n", what.c_str(), times.best_ms, times.median_ms);
  std::fflush(stdout);
}

class LargeCatalogue {
 public:
  LargeCatalogue(const std::string& folder, const Sizes& sizes)
      : path_(folder + "/large_catalogue.db"), sizes_(sizes) {
    remove();
    unit_draws_ = (sizes.sampled / sizes.units + 1) * schema::kFaultSampleEvery;
  }
  ~LargeCatalogue() { remove(); }

  void write() {
    open();
    const schema::Goal goal{{0, schema::kEndOfDraws}, (sizes_.units + 100) * unit_draws_, {}, {}};
    catalogue_->begin_run(invented_run(2), goal);
    std::puts("candidates,ms_a_candidate");
    double seconds = 0;
    for (std::uint64_t k = 1; k <= sizes_.units; ++k) {
      seconds += commit_seconds(sizes_.candidates / sizes_.units);
      if (k % (sizes_.units / 10) != 0) continue;
      std::printf("%llu,%.4f\n",
                  static_cast<unsigned long long>(k * (sizes_.candidates / sizes_.units)),
                  1000 * seconds / (static_cast<double>(sizes_.candidates) / 10));
      std::fflush(stdout);
      seconds = 0;
    }
    close();
  }

  void print_sizes() const {
    SQLite::Database database(path_);
    SQLite::Statement rows(database,
                           "SELECT name, sum(pgsize), sum(pgsize) * 1.0 / (SELECT count(*) FROM "
                           "candidate) FROM dbstat GROUP BY name ORDER BY 2 DESC LIMIT 10");
    std::puts("table_or_index,mb,bytes_a_candidate");
    while (rows.executeStep()) {
      std::printf("%s,%.1f,%.1f\n", rows.getColumn(0).getText(),
                  rows.getColumn(1).getDouble() / 1e6, rows.getColumn(2).getDouble());
    }
    const auto bytes = static_cast<double>(std::filesystem::file_size(path_));
    std::printf("file,%.1f,%.1f\n", bytes / 1e6, bytes / static_cast<double>(sizes_.candidates));
  }

  void time_queries() const {
    std::puts("query,plan");
    for (const auto& [name, sql] : named_queries()) {
      std::printf("%s,%s\n", name.c_str(), plan_of(sql).c_str());
    }
    std::puts("call,best_ms,median_ms");
    for (const auto& [name, sql] : named_queries()) {
      print("query " + name, time_five([&, &query = sql] {
              const auto database = schema::open_for_reading(path_);
              schema::query_table(*database, query, schema::TableStyle::aligned);
            }));
    }
    print("status", time_five([&] {
            const auto database = schema::open_for_reading(path_);
            search::status_text(schema::read_state(*database), {}, search::Paint(false));
          }));
    print("status --at 175", time_five([&] {
            const auto database = schema::open_for_reading(path_);
            const schema::CatalogueState state = schema::read_state(*database);
            search::status_text(state,
                                search::deploying_from(*database, state, draws_.campaign(), 175),
                                search::Paint(false));
          }));
  }

  void time_commits() {
    open();
    const schema::Goal goal{{0, schema::kEndOfDraws}, {}, 2 * sizes_.candidates, {}};
    print("begin a run with a goal of accepted draws",
          time_five([&] { catalogue_->begin_run(invented_run(2), goal); }));
    catalogue_->begin_run(invented_run(2), {});
    const auto commit = [&] { last_ms_.push_back(1000 * commit_seconds(1000)); };
    const auto print_commits = [&](const char* what) {
      last_ms_.clear();
      for (int k = 0; k < 6; ++k) commit();
      std::sort(last_ms_.begin() + 1, last_ms_.end());
      print(what, {last_ms_[1], last_ms_[3]});
    };
    print_commits("commit of a unit with 1000 candidates");
    close();
    {
      SQLite::Database database(path_, SQLite::OPEN_READWRITE);
      for (const char* index : {"best", "simplest", "smooth", "stroke", "tolerant"}) {
        database.exec(std::string("DROP INDEX candidate_") + index);
      }
    }
    open();
    catalogue_->begin_run(invented_run(2), {});
    print_commits("the same without the indexes of named queries");
    close();
  }

 private:
  void open() { catalogue_.emplace(path_, draws_.campaign(), draws_.mechanism()); }
  void close() {
    catalogue_->end_run("stopped");
    catalogue_.reset();
  }
  void remove() const {
    for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
      std::filesystem::remove(path_ + suffix);
    }
  }

  // Of the next unit.
  double commit_seconds(std::uint64_t candidates) {
    const schema::UnitRecord unit =
        draws_.unit({next_, next_ + unit_draws_}, {candidates, sizes_.sampled / sizes_.units, 200});
    next_ += unit_draws_;
    const Stopwatch watch;
    catalogue_->commit({unit});
    return watch.seconds();
  }

  static std::vector<std::pair<std::string, std::string>> named_queries() {
    std::vector<std::pair<std::string, std::string>> queries;
    for (const schema::CarriedFile& file : schema::carried_files()) {
      const std::filesystem::path path = file.path;
      if (path.parent_path() == "schema/queries") queries.emplace_back(path.stem(), file.text);
    }
    return queries;
  }

  std::string plan_of(const std::string& sql) const {
    SQLite::Database database(path_);
    SQLite::Statement steps(database, "EXPLAIN QUERY PLAN " + sql);
    std::string plan;
    while (steps.executeStep()) {
      plan += (plan.empty() ? "" : "; ") + steps.getColumn(3).getString();
    }
    return plan;
  }

  const std::string path_;
  const Sizes sizes_;
  std::uint64_t unit_draws_, next_ = 0;
  InventedDraws draws_{1};
  std::optional<schema::Catalogue> catalogue_;
  std::vector<double> last_ms_;
};

}  // namespace
}  // namespace misalign::bench

int main(int argc, char** argv) {
  misalign::bench::Sizes sizes;
  const char* folder = nullptr;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--candidates") == 0 && i + 1 < argc) {
      sizes.candidates = std::strtoull(argv[++i], nullptr, 10);
    } else if (std::strcmp(argv[i], "--sampled") == 0 && i + 1 < argc) {
      sizes.sampled = std::strtoull(argv[++i], nullptr, 10);
    } else {
      folder = argv[i];
    }
  }
  if (!folder) {
    std::fputs("usage: large_catalogue FOLDER [--candidates N] [--sampled N]\n", stderr);
    return 2;
  }
  misalign::bench::LargeCatalogue catalogue(folder, sizes);
  catalogue.write();
  catalogue.print_sizes();
  catalogue.time_queries();
  catalogue.time_commits();
}
