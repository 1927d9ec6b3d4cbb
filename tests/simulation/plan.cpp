#include "tests/simulation/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>

namespace misalign::simulation {
namespace {

double fraction(Random& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

template <class Item, std::size_t count>
Item one_of(const std::array<Item, count>& items, Random& random) {
  return items[up_to(random, count)];
}

// A time within a run, or soon after it.
Nanoseconds time_within(double run_s, Random& random) {
  return static_cast<Nanoseconds>(1.1e9 * run_s * fraction(random));
}

}  // namespace

bool Planner::is_in() {
  const int number = planned_++;
  return number >= 64 || (cast_.left_out >> number & 1) == 0;
}

int Planner::ranks(Random& random) const {
  return std::min(one_of(std::array{1, 1, 1, 1, 2, 2, 2, 3, 4, 12}, random), cast_.most_ranks);
}

Planned Planner::search(const Share& share, bool is_faulty, std::uint64_t calls, Random& random) {
  std::vector<std::string> words = told_.search_words(share.file, share.lo, share.hi);
  const auto add = [&](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  add({"--progress", one_of(std::array{"none", "plain", "json"}, random)});
  if (share.on_network) add({"--storage", "network"});
  if (!told_.is_split && happens(random, 0.5)) {
    add({"--unit-draws", std::to_string(1 + up_to(random, told_.goal / 4 + 1))});
  }
  Planned planned;
  planned.life.ranks = ranks(random);
  planned.life.seed = random();
  planned.life.work = told_.work;
  if (is_faulty) {
    planned.has_stopped_exit = happens(random, 0.5);
    if (planned.has_stopped_exit) add({"--stopped-exit", std::to_string(kStoppedExit)});
    const double run_s = told_.expected_s / planned.life.ranks + 0.2;
    planned.has_max_time = happens(random, 0.1) && is_in();
    if (planned.has_max_time) {
      add({"--max-time", fmt::format("{:.2f}", 0.01 + run_s * fraction(random))});
    }
    add_faults(planned.life, calls, random);
    add_signals(planned, run_s, random);
    add_visits(planned, run_s, share.on_network, random);
    std::ranges::sort(planned.life.happenings, {}, &Happening::at);
  }
  planned.life.program = program(words);
  return planned;
}

void Planner::add_faults(Life& life, std::uint64_t calls, Random& random) {
  using Kind = FaultKind;
  const auto count = one_of(std::array{0, 1, 1, 1, 2, 2}, random);
  for (int k = 0; k < count; ++k) {
    Fault fault{one_of(std::array{Kind::power_cut, Kind::power_cut, Kind::power_cut,
                                  Kind::power_cut, Kind::kill, Kind::kill, Kind::io_error,
                                  Kind::no_space, Kind::failed_sync, Kind::short_write},
                       random),
                1 + up_to(random, calls + calls / 4)};
    if (is_error(fault.kind))
      fault.lasts = one_of(std::array<std::uint64_t, 4>{0, 0, 20, 100000}, random);
    fault.after_call = happens(random, 0.5);
    if (is_in()) life.faults.push_back(fault);
  }
}

void Planner::add_signals(Planned& planned, double run_s, Random& random) {
  auto& happenings = planned.life.happenings;
  if (happens(random, 0.3) && is_in()) {
    const int signal = one_of(std::array{SIGTERM, SIGTERM, SIGINT, SIGUSR1, SIGHUP}, random);
    const Nanoseconds at = time_within(run_s, random);
    happenings.push_back({at, Happening::signal, signal});
    planned.has_signal = true;
    planned.is_drain = signal == SIGUSR1;
    planned.is_asked_twice = happens(random, 0.15);
    if (planned.is_asked_twice) {
      happenings.push_back({at + time_within(2, random), Happening::signal, signal});
    }
  }
  if (happens(random, 0.06) && is_in()) {
    happenings.push_back({time_within(run_s, random), Happening::signal, SIGKILL});
    planned.has_kill = true;
  }
  if (happens(random, 0.03) && planned.life.ranks > 1 && is_in()) {
    const auto others = static_cast<std::uint64_t>(planned.life.ranks - 1);
    happenings.push_back({time_within(run_s, random), Happening::silence,
                          static_cast<int>(1 + up_to(random, others))});
    planned.has_silence = true;
  }
}

void Planner::add_visits(Planned& planned, double run_s, bool on_network, Random& random) {
  const auto add = [&](Nanoseconds at, Visit visit) {
    planned.life.happenings.push_back({at, Happening::pause_job, static_cast<int>(visit)});
  };
  const auto count = one_of(std::array{0, 0, 1, 1, 2}, random);
  for (int k = 0; k < count; ++k) {
    const Visit visit = one_of(
        std::array{Visit::look, Visit::look, Visit::look, Visit::long_look, Visit::long_look,
                   Visit::lock, Visit::copy, Visit::take_away, Visit::cut_index, Visit::status,
                   Visit::query, Visit::verify, Visit::watch, Visit::second_search},
        random);
    // Readers of a shared disk must wait, and one of an older program is not taken away.
    const bool can_be = !on_network || visit == Visit::copy || visit == Visit::take_away;
    if (!is_in() || !can_be || (visit == Visit::take_away && told_.older_version)) continue;
    const Nanoseconds at = time_within(run_s, random);
    add(at, visit);
    if (visit != Visit::long_look && visit != Visit::lock) continue;
    add(at + time_within(run_s, random),
        visit == Visit::lock ? Visit::unlock : Visit::end_long_look);
  }
}

}  // namespace misalign::simulation
