#include "tests/bench/scale/simulated_run.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <random>
#include <vector>

#include "schema/catalogue/unit_writer.hpp"
#include "search/ranks/coordinator.hpp"
#include "search/ranks/dispatcher.hpp"

namespace misalign::bench {
namespace {

using schema::DrawRange;

// Workers differ by this much (standard deviation of the logarithm), and one worker's units.
constexpr double kSpread = 0.2, kNoise = 0.05;
constexpr double kBeat_s = 4;  // search/ranks/heartbeat

// search::Backoff: sleeps of 0, 50, 100, ... us, at most 1 ms.
class SimulatedBackoff {
 public:
  double next_s() {
    const double now_s = step_s_;
    step_s_ = std::min(1e-3, step_s_ + 50e-6);
    return now_s;
  }
  void reset() { step_s_ = 0; }

 private:
  double step_s_ = 0;
};

// When a worker that waits since `from_s` looks the first time at or after `arrival_s`.
double seen_s(double from_s, double arrival_s) {
  SimulatedBackoff backoff;
  double now_s = from_s;
  while (now_s < arrival_s) {
    const double step_s = backoff.next_s();
    now_s =
        step_s < 1e-3 ? now_s + step_s : now_s + std::ceil((arrival_s - now_s) / step_s) * step_s;
  }
  return now_s;
}

struct Unit {
  int worker;
  DrawRange range;
  double start_s, finish_s, arrival_s, committed_s;
  std::uint64_t candidates, sampled;
};

class Simulation {
 public:
  Simulation(const SimulatedCampaign& campaign, const Network& network, const Costs& costs)
      : campaign_(campaign),
        network_(network),
        costs_(costs),
        dispatcher_({{0, campaign.draws}, {}}, campaign.workers + 1, {}),
        random_(static_cast<unsigned>(campaign.workers)) {
    std::lognormal_distribution spread(0.0, kSpread);
    for (int rank = 0; rank <= campaign.workers; ++rank) {
      draws_per_s_.push_back(campaign.draws_per_s * spread(random_));
    }
    free_since_s_.assign(draws_per_s_.size(), 0);
  }

  SimulatedRun run() {
    for (int rank = 1; rank <= campaign_.workers; ++rank) assign(rank);
    SimulatedBackoff backoff;
    while (!dispatcher_.complete()) {
      const bool computed = compute_one_block();
      const bool received = receive_all();
      if (computed || received) {
        backoff.reset();
      } else {
        now_s_ += backoff.next_s();
      }
      beat();
    }
    return result();
  }

 private:
  struct Later {
    const std::vector<Unit>& units;
    bool operator()(std::size_t a, std::size_t b) const {
      return units[a].arrival_s > units[b].arrival_s;
    }
  };

  void spend(double seconds, double& account) {
    now_s_ += seconds;
    account += seconds;
  }

  void assign(int rank) {
    const auto range = dispatcher_.assign(rank);
    if (!range) {
      if (end_game_from_s_ < 0) end_game_from_s_ = now_s_;
      return;
    }
    ++messages_;
    spend(network_.message_s, messaging_s_);
    const double start_s = seen_s(free_since_s_[rank], now_s_ + network_.latency_s);
    std::lognormal_distribution noise(0.0, kNoise);
    const double draws = static_cast<double>(range->size());
    const double finish_s =
        start_s + costs_.unit_start_s + draws / draws_per_s_[rank] * noise(random_);
    free_since_s_[rank] = finish_s;
    begin(rank, *range, start_s, finish_s);
    arriving_.push(units_.size() - 1);
  }

  void begin(int rank, const DrawRange& range, double start_s, double finish_s) {
    const double draws = static_cast<double>(range.size());
    std::poisson_distribution<std::uint64_t> accepted(draws * campaign_.acceptance);
    units_.push_back({rank, range, start_s, finish_s, finish_s + network_.latency_s, 0,
                      accepted(random_), schema::FaultSampleRule().rows_in(range)});
  }

  bool compute_one_block() {
    if (campaign_.workers + 1 > search::kMostRanksWithOwnJobs) return false;
    if (!own_) {
      const auto range = dispatcher_.assign(0);
      if (!range) return false;
      begin(0, *range, now_s_, now_s_);
      own_ = units_.size() - 1;
      own_left_ = range->size();
      own_seconds_ = 0;
    }
    const double left_s = static_cast<double>(own_left_) / draws_per_s_[0];
    const std::vector<double>& blocks_s = campaign_.own_blocks.quantiles_s;
    std::uniform_int_distribution<std::size_t> any(0, blocks_s.size() - 1);
    const double block_s = std::min(left_s, blocks_s[any(random_)]);
    spend(block_s, computing_s_);
    own_seconds_ += block_s;
    own_left_ =
        block_s < left_s ? static_cast<std::uint64_t>((left_s - block_s) * draws_per_s_[0]) : 0;
    if (own_left_ == 0) {
      units_[*own_].finish_s = units_[*own_].arrival_s = now_s_;
      hand_on(*own_);
      commit({*own_});
      own_.reset();
    }
    return true;
  }

  // What has arrived is one transaction, and handed on before.
  bool receive_all() {
    std::vector<std::size_t> arrived;
    std::size_t rows = 0;
    while (rows < search::kMostRows && !arriving_.empty() &&
           units_[arriving_.top()].arrival_s <= now_s_) {
      const std::size_t k = arriving_.top();
      arriving_.pop();
      const Unit unit = units_[k];
      const auto of = [&](const UnitCost& cost) {
        return cost.of(1, static_cast<double>(unit.candidates), static_cast<double>(unit.sampled));
      };
      ++messages_;
      spend(network_.message_s + of(costs_.message_bytes) / network_.bytes_per_s +
                of(costs_.unpack_s),
            messaging_s_);
      hand_on(k);
      rows += 1 + unit.candidates + unit.sampled;
      arrived.push_back(k);
    }
    if (arrived.empty()) return false;
    commit(arrived);
    return true;
  }

  // The unit's worker gets other draws.
  void hand_on(std::size_t k) {
    const Unit unit = units_[k];
    dispatcher_.finish(unit.worker, unit.range.hi,
                       unit.worker > 0 ? unit.finish_s - unit.start_s : own_seconds_);
    if (unit.worker > 0) assign(unit.worker);
  }

  void commit(const std::vector<std::size_t>& done) {
    double candidates = 0, sampled = 0;
    for (const std::size_t k : done) {
      candidates += static_cast<double>(units_[k].candidates);
      sampled += static_cast<double>(units_[k].sampled);
    }
    const double units = static_cast<double>(done.size());
    const double seconds = costs_.commit_s.of(units, candidates, sampled);
    spend(seconds, committing_s_);
    longest_commit_s_ = std::max(longest_commit_s_, seconds);
    largest_commit_bytes_ =
        std::max(largest_commit_bytes_, costs_.message_bytes.of(units, candidates, sampled));
    ++commits_;
    for (const std::size_t k : done) units_[k].committed_s = now_s_;
  }

  // One beat to every worker and one from each, by a thread of rank 0 that shares its core.
  void beat() {
    for (; next_beat_s_ <= now_s_; next_beat_s_ += kBeat_s) {
      messages_ += 2 * static_cast<std::uint64_t>(campaign_.workers);
      spend(2 * campaign_.workers * network_.message_s, messaging_s_);
    }
  }

  SimulatedRun result() {
    SimulatedRun run{};
    const double total_draws_per_s = std::accumulate(draws_per_s_.begin(), draws_per_s_.end(), 0.0);
    run.wall_s = now_s_;
    run.efficiency = static_cast<double>(campaign_.draws) / (now_s_ * total_draws_per_s);
    run.messages_per_s = static_cast<double>(messages_) / now_s_;
    run.units_per_s = static_cast<double>(units_.size()) / now_s_;
    run.commits_per_s = static_cast<double>(commits_) / now_s_;
    run.committing = committing_s_ / now_s_;
    run.messaging = messaging_s_ / now_s_;
    run.computing = computing_s_ / now_s_;
    run.units = units_.size();
    for (const Unit& unit : units_) {
      run.candidates += unit.candidates;
      run.sampled += unit.sampled;
    }
    run.longest_commit_s = longest_commit_s_;
    run.largest_commit_bytes = largest_commit_bytes_;
    const double end_s = end_game_from_s_ < 0 ? now_s_ : end_game_from_s_;
    run.end_game_s = now_s_ - end_s;
    add_idle(run, end_s);
    add_lost(run, total_draws_per_s);
    return run;
  }

  void add_idle(SimulatedRun& run, double end_s) const {
    std::vector<double> busy_s(draws_per_s_.size(), 0);
    for (const Unit& unit : units_) {
      busy_s[unit.worker] += std::min(unit.finish_s, end_s) - std::min(unit.start_s, end_s);
    }
    for (std::size_t rank = 1; rank < busy_s.size(); ++rank) {
      const double idle = 1 - busy_s[rank] / end_s;
      run.idle_mean += idle / static_cast<double>(campaign_.workers);
      run.idle_worst = std::max(run.idle_worst, idle);
    }
  }

  // At random times: what was done by then and not committed.
  void add_lost(SimulatedRun& run, double total_draws_per_s) {
    constexpr int kTimes = 200;
    std::uniform_real_distribution any(0.0, now_s_);
    for (int k = 0; k < kTimes; ++k) {
      const double kill_s = any(random_);
      double lost = 0;
      for (const Unit& unit : units_) {
        if (kill_s <= unit.start_s || kill_s >= unit.committed_s) continue;
        const double part = (kill_s - unit.start_s) / (unit.finish_s - unit.start_s);
        lost += static_cast<double>(unit.range.size()) * std::min(1.0, part);
      }
      run.lost_mean_s += lost / total_draws_per_s / kTimes;
      run.lost_worst_s = std::max(run.lost_worst_s, lost / total_draws_per_s);
    }
  }

  const SimulatedCampaign& campaign_;
  const Network& network_;
  const Costs& costs_;
  search::Dispatcher dispatcher_;
  std::mt19937_64 random_;
  std::vector<double> draws_per_s_, free_since_s_;  // by rank
  std::vector<Unit> units_;
  std::priority_queue<std::size_t, std::vector<std::size_t>, Later> arriving_{Later{units_}};
  std::optional<std::size_t> own_;  // rank 0's unit
  std::uint64_t own_left_ = 0;
  double own_seconds_ = 0;
  double now_s_ = 0, next_beat_s_ = 0, end_game_from_s_ = -1;
  double committing_s_ = 0, messaging_s_ = 0, computing_s_ = 0, longest_commit_s_ = 0,
         largest_commit_bytes_ = 0;
  std::uint64_t messages_ = 0, commits_ = 0;
};

}  // namespace

SimulatedRun simulate(const SimulatedCampaign& campaign, const Network& network,
                      const Costs& costs) {
  return Simulation(campaign, network, costs).run();
}

}  // namespace misalign::bench
