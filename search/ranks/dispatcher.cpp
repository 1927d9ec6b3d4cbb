#include "search/ranks/dispatcher.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace misalign::search {

double unit_seconds(int workers) {
  constexpr double kUnit_s = 5, kUnitsPer_s = 200;
  return std::max(kUnit_s, workers / kUnitsPer_s);
}

std::uint64_t unit_draws(double draws_per_s, double unit_s, std::uint64_t open_draws, int workers) {
  constexpr std::uint64_t kFirstUnit = 32, kLeastUnit = 8;
  constexpr double kLeastPart = 0.05, kMostDraws = 1e15;
  if (draws_per_s <= 0) return kFirstUnit;
  const auto draws_in = [&](double seconds) {
    return static_cast<std::uint64_t>(std::min(draws_per_s * seconds, kMostDraws));
  };
  const std::uint64_t by_share =
      workers > 1 ? open_draws / (2 * static_cast<std::uint64_t>(workers)) : open_draws;
  const std::uint64_t least = std::max(kLeastUnit, draws_in(kLeastPart * unit_s));
  return std::max(least, std::min(draws_in(unit_s), by_share));
}

Dispatcher::Dispatcher(Ledger ledger, int workers, const UnitSize& size)
    : ledger_(std::move(ledger)), size_(size), workers_(workers) {
  if (size_.seconds == 0) size_.seconds = unit_seconds(workers);
}

std::optional<DrawRange> Dispatcher::assign(int worker) {
  assert(worker >= 0 && static_cast<std::size_t>(worker) < workers_.size());
  Worker& w = workers_[worker];
  assert(!w.assigned);
  const auto count = static_cast<int>(workers_.size());
  w.assigned = ledger_.take(
      size_.draws.value_or(unit_draws(w.draws_per_s, size_.seconds, ledger_.open_draws(), count)));
  return w.assigned;
}

void Dispatcher::finish(int worker, std::uint64_t done_to, double seconds) {
  Worker& w = workers_[worker];
  assert(w.assigned);
  assert(done_to >= w.assigned->lo && seconds >= 0);
  const std::uint64_t draws = done_to - w.assigned->lo;
  if (draws > 0 && seconds > 0) w.draws_per_s = static_cast<double>(draws) / seconds;
  ledger_.finish(*w.assigned, done_to);
  w.assigned.reset();
}

}  // namespace misalign::search
