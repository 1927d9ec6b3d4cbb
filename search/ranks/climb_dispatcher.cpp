#include "search/ranks/climb_dispatcher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "search/ranks/dispatcher.hpp"

namespace misalign::search {
namespace {

// Sizes of a worker's first pieces; the least size fills the lanes.
constexpr std::uint32_t kFirstDraws = 4096, kFirstParticles = 128, kLeastParticles = 64;
// Duration of a piece, which a kill can cost each rank.
constexpr double kPiece_s = 2;

}  // namespace

ClimbDispatcher::ClimbDispatcher(const Ladder& ladder, int last_score, Ledger populations,
                                 int workers, std::uint64_t most_found)
    : ladder_(ladder),
      populations_(std::move(populations)),
      workers_(workers),
      most_found_(most_found) {
  if (ladder.scores.empty() && populations_.open_draws() > 0) {
    level_finder_.emplace(ladder.seed, ladder.particles, ladder.first_draws, last_score);
  }
}

bool ClimbDispatcher::restore(PieceResult result) {
  const std::uint32_t number = result.population;
  if (number == LevelFinder::kNumber) {
    if (!level_finder_ || !level_finder_->restore(std::move(result))) return false;
    look_at_end(number);
    return true;
  }
  if (level_finder_) return false;
  Population* const population = climbing_.contains(number) ? &climbing_.at(number) : begin(number);
  if (!population || !population->restore(std::move(result))) return false;
  look_at_end(number);
  return true;
}

// Returns null if the population is done, or not needed.
Population* ClimbDispatcher::begin(std::uint32_t number) {
  if (!populations_.take({number, std::uint64_t{number} + 1})) return nullptr;
  return &climbing_.try_emplace(number, ladder_, number, most_found_).first->second;
}

std::optional<PieceOrder> ClimbDispatcher::assign(int worker) {
  Worker& w = workers_[static_cast<std::size_t>(worker)];
  assert(!w.population);
  if (level_finder_) return take(*level_finder_, w);
  for (auto& [number, population] : climbing_) {
    if (number >= end_) return std::nullopt;
    if (auto order = take(population, w)) return order;
  }
  const auto next = populations_.take(1);
  if (!next) return std::nullopt;
  const auto number = static_cast<std::uint32_t>(next->lo);
  return take(climbing_.try_emplace(number, ladder_, number, most_found_).first->second, w);
}

template <class Climb>
std::optional<PieceOrder> ClimbDispatcher::take(Climb& climb, Worker& worker) {
  const bool is_first = climb.is_at_first();
  auto order = climb.take(piece_size(worker, is_first, climb.open()));
  if (!order) return std::nullopt;
  worker.population = order->population;
  worker.end = order->hi;
  worker.is_first = is_first;
  worker.is_at_ends = !order->starts.empty();
  return order;
}

std::uint32_t ClimbDispatcher::piece_size(const Worker& worker, bool is_first,
                                          std::uint64_t open) const {
  const double per_s = is_first ? worker.first_per_s : worker.particles_per_s;
  if (per_s <= 0) return is_first ? kFirstDraws : kFirstParticles;
  // All workers share the open particles if no further population can begin.
  const int sharing =
      populations_.open_draws() > 0 && !level_finder_ ? 1 : static_cast<int>(workers_.size());
  const std::uint64_t size = unit_draws(per_s, kPiece_s, open, sharing);
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(size, kLeastParticles, kBeyondAll));
}

void ClimbDispatcher::finish(int worker, PieceResult result) {
  Worker& w = workers_[static_cast<std::size_t>(worker)];
  assert(w.population == result.population);
  const double done = result.hi - result.lo;
  if (done > 0 && result.seconds > 0 && !w.is_at_ends)
    (w.is_first ? w.first_per_s : w.particles_per_s) = done / result.seconds;
  const std::uint32_t number = *std::exchange(w.population, std::nullopt);
  if (number == LevelFinder::kNumber) {
    level_finder_->add(w.end, std::move(result));
  } else {
    climbing_.at(number).add(w.end, std::move(result));
  }
  look_at_end(number);
}

void ClimbDispatcher::look_at_end(std::uint32_t number) {
  if (number == LevelFinder::kNumber) {
    if (!level_finder_->is_done()) return;
    ladder_.scores = level_finder_->ladder().scores;
    level_finder_.reset();
    has_news_of_levels_ = true;
    return;
  }
  const auto at = climbing_.find(number);
  if (!at->second.is_done()) return;
  done_.push_back(at->second.record());
  climbing_.erase(at);
  const DrawRange range{number, std::uint64_t{number} + 1};
  populations_.finish(range, range.hi);
}

std::vector<PopulationRecord> ClimbDispatcher::take_done() { return std::exchange(done_, {}); }

void ClimbDispatcher::cut(std::uint64_t end) {
  end_ = std::min(end_, end);
  populations_.cut(end);
}

bool ClimbDispatcher::anything_open() const {
  if (level_finder_) return level_finder_->open() > 0;
  return populations_.open_draws() > 0 || std::ranges::any_of(climbing_, [&](const auto& climb) {
           return climb.first < end_ && climb.second.open() > 0;
         });
}

std::string ClimbDispatcher::under_way() const {
  if (level_finder_) return fmt::format("the level finder at level {}", level_finder_->level());
  if (climbing_.empty()) return "";
  const Population& lowest = climbing_.begin()->second;
  if (lowest.is_at_ends()) {
    return fmt::format("population {}, optimising its sheets", lowest.number());
  }
  return fmt::format("population {} at level {} of {}", lowest.number(), lowest.level(),
                     ladder_.top());
}

}  // namespace misalign::search
