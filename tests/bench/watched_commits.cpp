// A catalogue that gets candidates of miura-6x6 at a steady rate, with invented metrics: how long
// each commit takes while others look, and how much of that it waited: for locks and for the disk,
// not for a core that others have. CSV on standard output, once a minute and at the end.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "schema/catalogue/catalogue.hpp"
#include "search/terminal/stopwatch.hpp"
#include "tests/bench/scale/invented_draws.hpp"

namespace misalign::bench {
namespace {

// Of this thread, in seconds: on a core, and ready for one (Linux, Documentation/scheduler).
double scheduled_s() {
  std::ifstream file("/proc/thread-self/schedstat");
  double on_core_ns = 0, ready_ns = 0;
  file >> on_core_ns >> ready_ns;
  return 1e-9 * (on_core_ns + ready_ns);
}

struct CommitTime {
  double took_s, waited_s;
};

struct Rate {
  std::uint64_t before = 0;     // candidates that are there when it begins
  std::uint64_t each_s = 5000;  // candidates a second
  int commits_each_s = 4;
  int seconds = 60;
};

class SteadyWriter {
 public:
  SteadyWriter(const std::string& path, const Rate& rate)
      : rate_(rate), catalogue_(path, draws_.campaign(), draws_.mechanism()) {
    catalogue_.begin_run(invented_run(2), {{0, schema::kEndOfDraws}, {}, {}, {}});
  }
  ~SteadyWriter() { catalogue_.end_run("stopped"); }

  void fill() {
    for (std::uint64_t some = 0; some < rate_.before; some += 5000) commit(5000);
  }

  // Commits at their times, or as fast as they go.
  void run() {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    const int commits = rate_.seconds * rate_.commits_each_s;
    for (int k = 0; k < commits; ++k) {
      const std::chrono::duration<double> due(double(k) / rate_.commits_each_s);
      std::this_thread::sleep_until(begin + std::chrono::duration_cast<Clock::duration>(due));
      commits_.push_back(commit(rate_.each_s / rate_.commits_each_s));
      if ((k + 1) % (60 * rate_.commits_each_s) == 0 || k + 1 == commits) {
        const std::chrono::duration<double> took = Clock::now() - begin;
        print(k + 1, took.count());
      }
    }
  }

 private:
  CommitTime commit(std::uint64_t candidates) {
    constexpr std::uint64_t kDraws = 1 << 18;
    const schema::UnitRecord unit =
        draws_.unit({next_, next_ + kDraws}, {candidates, kDraws >> 10, 200});
    next_ += kDraws;
    const double before_s = scheduled_s();
    const search::Stopwatch watch;
    catalogue_.commit({unit});
    const double took_s = watch.seconds();
    return {took_s, std::max(0.0, took_s - (scheduled_s() - before_s))};
  }

  void print(int commits, double took_s) {
    const auto each = double(rate_.each_s / rate_.commits_each_s);
    std::printf("%d commits, %.0f candidates/s\nms,p50,p90,p99,longest\n", commits,
                commits * each / took_s);
    print_row("took", [](const CommitTime& time) { return time.took_s; });
    print_row("waited", [](const CommitTime& time) { return time.waited_s; });
    std::fflush(stdout);
  }

  template <class Which>
  void print_row(const char* what, const Which& which) const {
    std::vector<double> sorted;
    for (const CommitTime& time : commits_) sorted.push_back(1000 * which(time));
    std::sort(sorted.begin(), sorted.end());
    std::printf("%s", what);
    for (const double share : {0.5, 0.9, 0.99, 1.0}) {
      std::printf(",%.1f", sorted[static_cast<std::size_t>(share * double(sorted.size() - 1))]);
    }
    std::printf("\n");
  }

  const Rate rate_;
  InventedDraws draws_{1};
  schema::Catalogue catalogue_;
  std::uint64_t next_ = 0;
  std::vector<CommitTime> commits_;
};

}  // namespace
}  // namespace misalign::bench

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: watched_commits FILE.db CANDIDATES_BEFORE SECONDS\n", stderr);
    return 2;
  }
  misalign::bench::Rate rate;
  rate.before = std::strtoull(argv[2], nullptr, 10);
  rate.seconds = std::atoi(argv[3]);
  misalign::bench::SteadyWriter writer(argv[1], rate);
  writer.fill();
  writer.run();
}
