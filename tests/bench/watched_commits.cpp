// A catalogue that gets candidates of miura-6x6 at a steady rate, with invented metrics: how long
// each commit takes, for who looks meanwhile. CSV on standard output, once a minute and at the end.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "schema/catalogue/catalogue.hpp"
#include "search/terminal/stopwatch.hpp"
#include "tests/bench/scale/invented_draws.hpp"

namespace misalign::bench {
namespace {

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
      commit_s_.push_back(commit(rate_.each_s / rate_.commits_each_s));
      if ((k + 1) % (60 * rate_.commits_each_s) == 0 || k + 1 == commits) {
        const std::chrono::duration<double> took = Clock::now() - begin;
        print(k + 1, took.count());
      }
    }
  }

 private:
  double commit(std::uint64_t candidates) {
    constexpr std::uint64_t kDraws = 1 << 18;
    const schema::UnitRecord unit =
        draws_.unit({next_, next_ + kDraws}, {candidates, kDraws >> 10, 200});
    next_ += kDraws;
    const search::Stopwatch watch;
    catalogue_.commit({unit});
    return watch.seconds();
  }

  void print(int commits, double took_s) {
    std::vector<double> sorted = commit_s_;
    std::sort(sorted.begin(), sorted.end());
    const auto ms = [&](double share) {
      return 1000 * sorted[static_cast<std::size_t>(share * double(sorted.size() - 1))];
    };
    const auto each = double(rate_.each_s / rate_.commits_each_s);
    std::printf(
        "commits,candidates_per_s,p50_ms,p90_ms,p99_ms,longest_ms\n%d,%.0f,%.1f,%.1f,%.1f,%.1f\n",
        commits, commits * each / took_s, ms(0.5), ms(0.9), ms(0.99), ms(1));
    std::fflush(stdout);
  }

  const Rate rate_;
  InventedDraws draws_{1};
  schema::Catalogue catalogue_;
  std::uint64_t next_ = 0;
  std::vector<double> commit_s_;
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
