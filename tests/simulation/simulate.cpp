// simulate SEED: plays one story and tells it. simulate FIRST LAST [JOBS [MOST_FAILURES]]: plays
// many, and prints a table of what happened. simulate SEED --shrink: the smallest cast that still
// fails. simulate --scenarios: what stories have found.
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "tests/simulation/campaigns.hpp"
#include "tests/simulation/scenarios.hpp"
#include "tests/simulation/story.hpp"

namespace misalign::simulation {
namespace {

constexpr unsigned kLongestSeed_s = 300;

// Memory that the jobs share.
struct Board {
  Tally tally[64];
  std::uint64_t seed[64];
  std::uint64_t failures;
};

template <class T>
T* shared() {
  void* const place =
      ::mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (place == MAP_FAILED) std::abort();
  return static_cast<T*>(place);
}

std::string folder_of(int job) {
  return fmt::format("/dev/shm/misalign-simulation-{}-{}", ::getpid(), job);
}

void report(std::uint64_t seed, const std::string& wrong) {
  fmt::print("seed {}: {}\n  again: simulate {}\n", seed, wrong, seed);
  std::fflush(stdout);
}

struct Range {
  std::uint64_t first, last;
  int jobs;
  std::uint64_t most_failures;
};

void play_share(const Range& range, int job, std::uint64_t from, Disk& disk, Board& board) {
  disk.use();
  warm_up(disk);
  for (std::uint64_t seed = from; seed < range.last && board.failures < range.most_failures;
       seed += static_cast<std::uint64_t>(range.jobs)) {
    board.seed[job] = seed;
    ::alarm(kLongestSeed_s);
    int planned = 0;
    const std::string wrong = play(seed, disk, {}, board.tally[job], planned);
    if (wrong.empty()) continue;
    ++board.failures;
    report(seed, wrong);
  }
}

using Hits = decltype(DiskState::hits);
using Seen = decltype(DiskState::seen);

// Prints the sites that were never hit; returns the share of those that were.
double print_sites(const std::vector<std::unique_ptr<Disk>>& disks) {
  std::string never;
  std::uint64_t sites = 0, hit = 0;
  for (int work = 0; work < kWorks; ++work) {
    for (int part = 0; part < kParts; ++part) {
      for (int call = 0; call < kCalls; ++call) {
        for (int kind = 0; kind < kFaults; ++kind) {
          std::uint64_t seen = 0, hits = 0;
          for (const auto& disk : disks) {
            seen += disk->state().seen[work][part][call];
            hits += disk->state().hits[work][part][call][kind];
          }
          const bool is_site = seen > 0 && fits(static_cast<FaultKind>(kind),
                                                static_cast<Call>(call), static_cast<Part>(part));
          sites += is_site;
          hit += is_site && hits > 0;
          if (is_site && hits == 0) {
            never += fmt::format("  {} of {} during {} ({} calls)\n", kFaultNames[kind],
                                 std::string(kCallNames[call]) + " " + kPartNames[part],
                                 kWorkNames[work], seen);
          }
        }
      }
    }
  }
  fmt::print("fault sites (fault x call x file x phase): {} of {} hit; never hit:\n{}", hit, sites,
             never.empty() ? "  none\n" : never);
  return static_cast<double>(hit) / static_cast<double>(std::max<std::uint64_t>(sites, 1));
}

void print_tally(const Tally& all, double seconds, std::uint64_t failures) {
  fmt::print(
      "{} seeds ({} with real draws) in {:.0f} s: {} lives, {} kills, {} power cuts, {} stops, {} "
      "lost ranks,\n{} looks, {} locks of other programs, {} copies, {} merges, {} migrations, {} "
      "runs of certify, {} of tolerance, {} of export, {} second searches; {} failures\n",
      all.seeds, all.real_seeds, seconds, all.lives, all.kills, all.power_cuts, all.stops,
      all.lost_ranks, all.looks, all.lock_holders, all.copies, all.merges, all.migrations,
      all.certify_runs, all.yield_runs, all.exports, all.second_searches, failures);
}

// Returns whether no seed was left out, and (of many) everything has happened that a story holds,
// at four in ten of the sites at least, of very many at half: 293 of 610 were hit by 2,000 seeds,
// 440 of 650 by 16,000.
bool is_all_played(const Range& range, const Tally& all, double share_of_sites) {
  constexpr std::uint64_t kMany = 2000, kVeryMany = 10000;
  const std::uint64_t seeds = range.last - range.first;
  const auto* const counts = reinterpret_cast<const std::uint64_t*>(&all);
  const bool is_all =
      all.seeds == seeds &&
      (seeds < kMany || (share_of_sites > (seeds < kVeryMany ? 0.4 : 0.5) &&
                         std::count(counts, counts + sizeof all / sizeof *counts, 0) == 0));
  if (!is_all) fmt::print("not everything was played\n");
  return is_all;
}

int play_range(const Range& range) {
  Board& board = *shared<Board>();
  std::vector<std::unique_ptr<Disk>> disks;
  const auto begin = std::chrono::steady_clock::now();
  std::vector<pid_t> jobs;
  const auto start = [&](int job, std::uint64_t from) {
    const pid_t id = ::fork();
    if (id == 0) {
      play_share(range, job, from, *disks[static_cast<std::size_t>(job)], board);
      std::fflush(stdout);
      end_job(0);
    }
    return id;
  };
  for (int job = 0; job < range.jobs; ++job)
    disks.push_back(std::make_unique<Disk>(folder_of(job)));
  for (int job = 0; job < range.jobs; ++job) {
    jobs.push_back(start(job, range.first + static_cast<std::uint64_t>(job)));
  }
  for (int left = range.jobs; left > 0;) {
    int status = 0;
    const pid_t ended = ::wait(&status);
    const auto job = static_cast<int>(std::ranges::find(jobs, ended) - jobs.begin());
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
      --left;
      continue;
    }
    ++board.failures;
    report(board.seed[job],
           fmt::format("the simulation itself was ended by {}", strsignal(WTERMSIG(status))));
    jobs[static_cast<std::size_t>(job)] =
        start(job, board.seed[job] + static_cast<std::uint64_t>(range.jobs));
  }
  Tally all{};
  for (int job = 0; job < range.jobs; ++job) {
    const auto* const one = reinterpret_cast<const std::uint64_t*>(&board.tally[job]);
    auto* const sum = reinterpret_cast<std::uint64_t*>(&all);
    for (std::size_t k = 0; k < sizeof all / sizeof *sum; ++k) sum[k] += one[k];
  }
  print_tally(all, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
              board.failures);
  const double share_of_sites = print_sites(disks);
  for (const auto& disk : disks) std::filesystem::remove_all(disk->folder());
  return board.failures == 0 && is_all_played(range, all, share_of_sites) ? EXIT_SUCCESS
                                                                          : EXIT_FAILURE;
}

// Leaves out ranks, lives and single faults in turn, as long as the seed still fails.
int shrink(std::uint64_t seed) {
  Disk disk(folder_of(0));
  disk.use();
  Tally tally{};
  Cast cast;
  int planned = 0;
  const auto fails = [&](const Cast& some) {
    return !play(seed, disk, some, tally, planned).empty();
  };
  if (!fails(cast)) {
    fmt::print("seed {} does not fail\n", seed);
    return EXIT_FAILURE;
  }
  for (const int ranks : {1, 2, 3}) {
    Cast fewer = cast;
    fewer.most_ranks = ranks;
    if (!fails(fewer)) continue;
    cast = fewer;
    break;
  }
  for (int lives = 0; lives < cast.most_faulty_lives; ++lives) {
    Cast fewer = cast;
    fewer.most_faulty_lives = lives;
    if (fails(fewer)) cast = fewer;
  }
  for (int bit = 0; bit < 64; ++bit) {
    Cast fewer = cast;
    fewer.left_out |= std::uint64_t{1} << bit;
    if (fails(fewer)) cast = fewer;
  }
  cast.tells = true;
  fmt::print("{}\n", play(seed, disk, cast, tally, planned));
  std::filesystem::remove_all(disk.folder());
  return EXIT_FAILURE;
}

int tell(std::uint64_t seed) {
  Disk disk(folder_of(0));
  disk.use();
  Tally tally{};
  int planned = 0;
  const std::string wrong = play(seed, disk, {.tells = true}, tally, planned);
  if (!wrong.empty()) report(seed, wrong);
  std::filesystem::remove_all(disk.folder());
  return wrong.empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}

int scenarios() {
  Disk disk(folder_of(0));
  disk.use();
  const bool are_good = play_scenarios(disk);
  std::filesystem::remove_all(disk.folder());
  return are_good ? EXIT_SUCCESS : EXIT_FAILURE;
}

int usage() {
  std::fputs("usage: simulate SEED [--shrink] | FIRST LAST [JOBS [MOST_FAILURES]] | --scenarios\n",
             stderr);
  return 2;
}

}  // namespace
}  // namespace misalign::simulation

int main(int argc, char** argv) {
  using namespace misalign::simulation;
  std::signal(SIGHUP, SIG_DFL);  // nohup would have searches ignore it
  const auto number = [&](int k) { return std::strtoull(argv[k], nullptr, 10); };
  if (argc == 2 && std::strcmp(argv[1], "--scenarios") == 0) return scenarios();
  if (argc == 2) return tell(number(1));
  if (argc == 3 && std::strcmp(argv[2], "--shrink") == 0) return shrink(number(1));
  if (argc < 3 || argc > 5) return usage();
  return play_range({number(1), number(2), argc > 3 ? static_cast<int>(number(3)) : 1,
                     argc > 4 ? number(4) : 20});
}
