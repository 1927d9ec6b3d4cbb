#include "tests/bench/scale/costs.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/ranks/messages.hpp"
#include "search/terminal/stopwatch.hpp"
#include "tests/bench/scale/invented_draws.hpp"

namespace misalign::bench {
namespace {

using schema::UnitRecord;
using search::Stopwatch;

// What the tests saw of a real unit of a million draws.
constexpr int kScreened = 200;
constexpr int kRounds = 8;
constexpr std::uint64_t kUnitDraws = 20 << 20;

// Units one after the other.
class UnitSource {
 public:
  std::vector<UnitRecord> next(int units, const UnitContents& contents) {
    std::vector<UnitRecord> all;
    for (int k = 0; k < units; ++k) {
      schema::DrawRange range{lo_, lo_ + kUnitDraws};
      // The rows of the fault sample get rarer.
      while (schema::FaultSampleRule().rows_in(range) < contents.sampled) range.hi += range.size();
      all.push_back(draws_.unit(range, contents));
      lo_ = range.hi;
    }
    return all;
  }
  InventedDraws& draws() { return draws_; }

 private:
  InventedDraws draws_{1};
  std::uint64_t lo_ = 0;
};

// A catalogue in a file of its own, removed in the end.
class ScratchCatalogue {
 public:
  ScratchCatalogue(const std::string& folder, const InventedDraws& draws)
      : path_(folder + "/scale_costs.db") {
    remove();
    catalogue_ = std::make_unique<schema::Catalogue>(path_, draws.campaign(), draws.mechanism());
    catalogue_->begin_run(invented_run(2), {});
  }
  ~ScratchCatalogue() {
    catalogue_.reset();
    remove();
  }

  // Mean time of a commit of `units` units each, checkpoints of the log included: in the best of
  // some rounds, for others use this machine too.
  double commit(UnitSource& source, int commits, int units, const UnitContents& contents) {
    double best = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
      double seconds = 0;
      for (int k = 0; k < commits; ++k) {
        const std::vector<UnitRecord> batch = source.next(units, contents);
        const Stopwatch watch;
        catalogue_->commit(batch);
        seconds += watch.seconds();
        units_ += units;
      }
      best = std::min(best, seconds / commits);
    }
    return best;
  }
  int units() const { return units_; }
  double bytes() const {
    schema::open_for_writing(path_, schema::Storage::local)->exec("PRAGMA wal_checkpoint");
    return static_cast<double>(std::filesystem::file_size(path_));
  }

 private:
  void remove() const {
    for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(path_ + suffix);
  }
  const std::string path_;
  std::unique_ptr<schema::Catalogue> catalogue_;
  int units_ = 0;
};

void measure_commits(const std::string& folder, Costs& costs) {
  UnitSource source;
  ScratchCatalogue catalogue(folder, source.draws());
  // Per row of what was written since the last call.
  double bytes = catalogue.bytes();
  const auto row_bytes = [&](double rows) {
    const double before = std::exchange(bytes, catalogue.bytes());
    return (bytes - before) / rows;
  };
  const double one = catalogue.commit(source, 50, 1, {0, 0, kScreened});
  const double many = catalogue.commit(source, 5, 200, {0, 0, kScreened});
  UnitCost& commit_s = costs.commit_s;
  commit_s.unit = std::max(0.0, (many - one) / 199);
  commit_s.fixed = one - commit_s.unit;
  costs.row_bytes.unit = row_bytes(catalogue.units());

  constexpr int kCandidates = 500, kSampled = 10000, kCommits = 10;
  const double candidates = catalogue.commit(source, kCommits, 1, {kCandidates, 0, kScreened});
  commit_s.candidate = (candidates - one) / kCandidates;
  costs.row_bytes.candidate = row_bytes(kRounds * kCommits * kCandidates);
  const double sampled = catalogue.commit(source, kCommits, 1, {0, kSampled, kScreened});
  commit_s.sampled = (sampled - one) / kSampled;
  costs.row_bytes.sampled = row_bytes(kRounds * kCommits * kSampled);
}

// The shortest of a few times.
double shortest_s(const std::function<void()>& call) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 50; ++k) {
    const Stopwatch watch;
    call();
    shortest = std::min(shortest, watch.seconds());
  }
  return shortest;
}

void measure_messages(Costs& costs) {
  UnitSource source;
  const auto measure = [&](const UnitContents& contents) {
    const search::Bytes bytes = search::pack({source.next(1, contents).front(), false});
    const double seconds = shortest_s([&] { search::unpack_unit(bytes); });
    return std::pair{seconds, static_cast<double>(bytes.size())};
  };
  constexpr int kCandidates = 1000, kSampled = 10000;
  const auto [unit_s, unit_bytes] = measure({0, 0, kScreened});
  const auto [candidates_s, candidates_bytes] = measure({kCandidates, 0, kScreened});
  const auto [sampled_s, sampled_bytes] = measure({0, kSampled, kScreened});
  costs.unpack_s = {0, unit_s, (candidates_s - unit_s) / kCandidates,
                    (sampled_s - unit_s) / kSampled};
  costs.message_bytes = {0, unit_bytes, (candidates_bytes - unit_bytes) / kCandidates,
                         (sampled_bytes - unit_bytes) / kSampled};
}

BlockTimes measure_blocks(double threshold_deg) {
  constexpr double kFor_s = 20;
  constexpr std::size_t kQuantiles = 50;
  schema::Campaign campaign = schema::default_campaign();
  campaign.threshold_deg = threshold_deg;
  search::DrawEvaluator evaluator(campaign);
  search::UnitWork work(evaluator, {0, schema::kEndOfDraws});
  std::vector<double> blocks;
  double sum = 0, squares = 0;
  const Stopwatch all;
  while (all.seconds() < kFor_s) {
    const Stopwatch watch;
    work.run_next_block();
    const double s = watch.seconds();
    blocks.push_back(s);
    sum += s;
    squares += s * s;
  }
  const double draws = static_cast<double>(work.take().range.size());
  std::sort(blocks.begin(), blocks.end());
  BlockTimes times{threshold_deg, draws / all.seconds(), squares / (2 * sum), {}};
  for (std::size_t k = 0; k < kQuantiles; ++k) {
    times.quantiles_s.push_back(blocks[(2 * k + 1) * blocks.size() / (2 * kQuantiles)]);
  }
  return times;
}

// The first draws of a unit go through the lanes in blocks of 1, 2, 4, ...
double measure_unit_start() {
  search::DrawEvaluator evaluator(schema::default_campaign());
  search::work_off(evaluator, {0, 4096});
  std::uint64_t lo = 1;
  return shortest_s([&] {
    search::work_off(evaluator, {lo, lo + 32});
    lo += 1024;
  });
}

}  // namespace

Costs measure_costs(const std::string& folder) {
  Costs costs{};
  measure_commits(folder, costs);
  measure_messages(costs);
  costs.unit_start_s = measure_unit_start();
  costs.fast = measure_blocks(170);
  costs.slow = measure_blocks(60);
  return costs;
}

}  // namespace misalign::bench
