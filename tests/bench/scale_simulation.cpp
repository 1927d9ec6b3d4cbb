// Simulates a search with ten thousand workers and a million million draws, on one machine: the
// real Dispatcher and Ledger with simulated workers, and the real catalogue with invented rows.
// `costs` measures what the simulation reckons with; CSV or JSON on standard output.
#include <cstdio>
#include <cstring>
#include <fstream>

#include "schema/files/input.hpp"
#include "tests/bench/scale/large_ledger.hpp"
#include "tests/bench/scale/simulated_run.hpp"

namespace misalign::bench {
namespace {

using schema::Json;

Json json_of(const UnitCost& cost) {
  return {{"fixed", cost.fixed},
          {"unit", cost.unit},
          {"candidate", cost.candidate},
          {"sampled", cost.sampled}};
}

UnitCost cost_of(const Json& json) {
  return {json.at("fixed"), json.at("unit"), json.at("candidate"), json.at("sampled")};
}

Json json_of(const BlockTimes& blocks) {
  return {{"threshold_deg", blocks.threshold_deg},
          {"draws_per_s", blocks.draws_per_s},
          {"mean_wait_s", blocks.mean_wait_s},
          {"quantiles_s", blocks.quantiles_s}};
}

BlockTimes blocks_of(const Json& json) {
  return {json.at("threshold_deg"), json.at("draws_per_s"), json.at("mean_wait_s"),
          json.at("quantiles_s")};
}

void print_costs(const std::string& folder) {
  const Costs costs = measure_costs(folder);
  const Json json = {{"commit_s", json_of(costs.commit_s)},
                     {"unpack_s", json_of(costs.unpack_s)},
                     {"message_bytes", json_of(costs.message_bytes)},
                     {"row_bytes", json_of(costs.row_bytes)},
                     {"unit_start_s", costs.unit_start_s},
                     {"fast", json_of(costs.fast)},
                     {"slow", json_of(costs.slow)}};
  std::printf("%s\n", json.dump(1).c_str());
}

Costs read_costs(const std::string& path) {
  std::ifstream file(path);
  const Json json = Json::parse(file);
  return {cost_of(json.at("commit_s")),      cost_of(json.at("unpack_s")),
          cost_of(json.at("message_bytes")), cost_of(json.at("row_bytes")),
          json.at("unit_start_s"),           blocks_of(json.at("fast")),
          blocks_of(json.at("slow"))};
}

// A row of a table, and before the first one the names of its columns.
class Table {
 public:
  using Row = std::vector<std::pair<const char*, double>>;
  void print(const char* name, const Row& row) {
    if (!named_) {
      std::printf("name");
      for (const auto& [column, value] : row) std::printf(",%s", column);
      std::printf("\n");
    }
    named_ = true;
    std::printf("%s", name);
    for (const auto& [column, value] : row) std::printf(",%.6g", value);
    std::printf("\n");
    std::fflush(stdout);
  }

 private:
  bool named_ = false;
};

double real(std::uint64_t count) { return static_cast<double>(count); }

Table::Row row_of(const SimulatedCampaign& campaign, const SimulatedRun& run, const Costs& costs) {
  return {{"draws_per_s", campaign.draws_per_s},
          {"acceptance", campaign.acceptance},
          {"workers", campaign.workers},
          {"draws", real(campaign.draws)},
          {"wall_s", run.wall_s},
          {"efficiency", run.efficiency},
          {"messages_per_s", run.messages_per_s},
          {"units_per_s", run.units_per_s},
          {"commits_per_s", run.commits_per_s},
          {"idle_mean", run.idle_mean},
          {"idle_worst", run.idle_worst},
          {"committing", run.committing},
          {"messaging", run.messaging},
          {"computing", run.computing},
          {"units", real(run.units)},
          {"units_mb", costs.row_bytes.unit * real(run.units) / 1e6},
          {"candidates_mb", costs.row_bytes.candidate * real(run.candidates) / 1e6},
          {"fault_sample_mb", costs.row_bytes.sampled * real(run.sampled) / 1e6},
          {"longest_commit_s", run.longest_commit_s},
          {"largest_commit_mb", run.largest_commit_bytes / 1e6},
          {"end_game_s", run.end_game_s},
          {"lost_mean_s", run.lost_mean_s},
          {"lost_worst_s", run.lost_worst_s}};
}

void print_runs(const Costs& costs) {
  // Not measured, but what such networks are said to do.
  constexpr Network kNetworks[] = {{"shared memory", 20e-6, 2e-6, 5e9},
                                   {"bad network", 1e-3, 10e-6, 1e8}};
  constexpr double kWanted_s = 1000;
  const SimulatedCampaign large{10000, 200000, 1e-6, costs.fast, 1000000000000};
  Table table;
  for (const Network& network : kNetworks) {
    for (const auto& [draws_per_s, acceptance] :
         {std::pair{200000.0, 1e-6}, {200000.0, 4.6e-4}, {1000.0, 1e-6}, {1000.0, 0.04}}) {
      for (int workers = 1; workers <= 10000; workers *= 10) {
        const SimulatedCampaign campaign{
            workers, draws_per_s, acceptance, draws_per_s > 1e5 ? costs.fast : costs.slow,
            static_cast<std::uint64_t>(draws_per_s * (workers + 1) * kWanted_s)};
        table.print(network.name, row_of(campaign, simulate(campaign, network, costs), costs));
      }
    }
    table.print(network.name, row_of(large, simulate(large, network, costs), costs));
  }
}

void print_ledgers(const std::string& folder) {
  constexpr std::uint64_t kDraws = 1000000000000;
  Table table;
  for (const LedgerSize& size : {LedgerSize{kDraws, 10000000, 0, 0},
                                 {kDraws, 10000000, 0.01, 0},
                                 {kDraws, 1000000, 0, 0},
                                 {kDraws, 1000000, 0.01, 0},
                                 {kDraws, 50000, 0, 0},
                                 {kDraws, 50000, 0.01, 0},
                                 {kDraws, 10000000, 0, 1000000},
                                 {kDraws, 10000000, 0, 10000000},
                                 {kDraws, 10000000, 0, 100000000}}) {
    const LedgerTimes times = time_large_ledger(folder, size);
    table.print("ledger", {{"draws", real(size.draws)},
                           {"unit_draws", real(size.unit_draws)},
                           {"missing", size.missing},
                           {"fault_sample", real(size.sampled)},
                           {"units", real(times.units)},
                           {"gaps", real(times.gaps)},
                           {"file_mb", real(times.bytes) / 1e6},
                           {"open_s", times.open_s},
                           {"begin_run_s", times.begin_run_s},
                           {"done_s", times.done_s},
                           {"ledger_s", times.ledger_s},
                           {"resume_mb", times.resume_mb},
                           {"status_s", times.status_s},
                           {"status_uncached_s", times.status_with_file_uncached_s},
                           {"status_mb", times.status_mb}});
  }
}

}  // namespace
}  // namespace misalign::bench

int main(int argc, char** argv) {
  const auto asked = [&](const char* verb) { return argc == 3 && std::strcmp(argv[1], verb) == 0; };
  if (asked("costs")) {
    misalign::bench::print_costs(argv[2]);
  } else if (asked("run")) {
    misalign::bench::print_runs(misalign::bench::read_costs(argv[2]));
  } else if (asked("resume")) {
    misalign::bench::print_ledgers(argv[2]);
  } else {
    std::fputs("usage: scale_simulation costs FOLDER | run COSTS.json | resume FOLDER\n", stderr);
    return 2;
  }
}
