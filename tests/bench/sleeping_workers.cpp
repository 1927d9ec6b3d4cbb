// The program's own coordinator, messages and catalogue under mpirun, with workers that sleep
// instead of following paths: what tests/bench/scale/simulated_run reckons, seen. One line on
// standard output.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "schema/campaign/campaign_file.hpp"
#include "search/ranks/coordinator.hpp"
#include "search/ranks/draw_task.hpp"
#include "search/ranks/stop_signal.hpp"
#include "search/terminal/stopwatch.hpp"
#include "tests/bench/scale/invented_draws.hpp"

namespace misalign::bench {
namespace {

using search::MpiSession;
using search::Stopwatch;

struct Speed {
  double draws_per_s, acceptance;
};

// Seconds with and without a range, up to its last unit.
struct Balance {
  double busy_s = 0, idle_s = 0;
};

Balance sleep_through_ranges(const MpiSession& mpi, const Speed& speed) {
  InventedDraws draws(static_cast<unsigned>(mpi.rank()));
  Balance balance;
  double waiting_s = 0;
  for (;;) {
    Stopwatch wait;
    const search::Bytes job = mpi.receive_job();
    waiting_s += wait.seconds();
    if (job.empty()) return balance;
    const schema::DrawRange range = search::unpack_range(job);
    balance.idle_s += waiting_s;
    const Stopwatch work;
    const auto count = static_cast<double>(range.size());
    std::this_thread::sleep_for(std::chrono::duration<double>(count / speed.draws_per_s));
    schema::UnitRecord unit =
        draws.unit(range, {static_cast<std::uint64_t>(count * speed.acceptance),
                           schema::FaultSampleRule().rows_in(range), 200});
    unit.seconds = work.seconds();
    balance.busy_s += work.seconds();
    const Stopwatch send;
    mpi.send_result(search::pack(search::SentUnit{unit, false}));
    waiting_s = send.seconds();
  }
}

int run(const std::string& folder, const Speed& speed, double seconds) {
  MpiSession mpi;
  search::watch_for_signals();
  search::Heartbeat heartbeat(mpi);
  Balance balance;
  if (mpi.rank() > 0) {
    balance = sleep_through_ranges(mpi, speed);
  } else {
    const std::string path = folder + "/sleeping_workers.db";
    std::filesystem::remove(path);
    search::DrawEvaluator evaluator(schema::default_campaign());
    schema::Catalogue catalogue(path, evaluator.campaign(), evaluator.mechanism());
    schema::Goal goal;
    goal.draws = static_cast<std::uint64_t>(speed.draws_per_s * (mpi.ranks() - 1) * seconds);
    catalogue.begin_run(invented_run(mpi.ranks()), goal);
    const Stopwatch watch;
    search::CoordinatorOptions options;
    options.progress = search::ProgressStyle::none;
    search::DrawTask task(evaluator, catalogue, goal, mpi.ranks(), {});
    search::run_coordinator(mpi, heartbeat, task, options);
    std::printf("%d,%g,%g,%.2f,%llu,%.4f,%.4f", mpi.ranks() - 1, speed.draws_per_s,
                speed.acceptance, watch.seconds(),
                static_cast<unsigned long long>(catalogue.cost().commits),
                catalogue.cost().seconds / watch.seconds(), catalogue.cost().longest_s);
    catalogue.end_run("complete");
    std::filesystem::remove(path);
  }
  const auto all = mpi.gather(std::to_string(balance.idle_s / (balance.idle_s + balance.busy_s)));
  if (mpi.rank() == 0) {
    double sum = 0, worst = 0;
    for (std::size_t rank = 1; rank < all.size(); ++rank) {
      sum += std::stod(all[rank]);
      worst = std::max(worst, std::stod(all[rank]));
    }
    std::printf(",%.4f,%.4f\n", sum / (mpi.ranks() - 1), worst);
  }
  mpi.meet();
  return 0;
}

}  // namespace
}  // namespace misalign::bench

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("usage: mpirun -n N sleeping_workers FOLDER DRAWS_PER_S ACCEPTANCE SECONDS\n",
               stderr);
    return 2;
  }
  return misalign::bench::run(argv[1], {std::atof(argv[2]), std::atof(argv[3])},
                              std::atof(argv[4]));
}
