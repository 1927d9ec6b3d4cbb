#include "search/draws/ascents.hpp"

#include <cassert>
#include <utility>

#include "search/terminal/stopwatch.hpp"

namespace misalign::search {

void Ascents::begin(schema::UnitRecord block, const schema::FaultSampleRule& sampled) {
  block_ = std::move(block);
  sampled_ = sampled;
  next_ = 0;
}

void Ascents::advance(const std::function<void(schema::Candidate&)>& kept) {
  constexpr double kAdvance_s = 0.08;
  const Stopwatch watch;
  while (!finished() && watch.seconds() < kAdvance_s) {
    if (schema::Candidate* const candidate = look()) kept(*candidate);
  }
}

// Evaluates one more sheet. Returns the candidate if its ascent has ended, mostly null.
schema::Candidate* Ascents::look() {
  schema::Candidate& candidate = block_->candidates[next_];
  if (!ascent_) {
    ascent_ = ascend_(campaign_, model_, std::move(candidate));
  } else if (!ascent_->finished()) {
    ascent_->advance();
  }
  if (!ascent_->finished()) return nullptr;
  candidate = ascent_->take();
  const bool has_kept_it = is_kept(candidate.draw);
  ascent_.reset();
  if (!has_kept_it) {
    block_->candidates.erase(block_->candidates.begin() + static_cast<std::ptrdiff_t>(next_));
    return nullptr;
  }
  ++next_;
  return &candidate;
}

// Judges the draw's end, where ends are judged.
bool Ascents::is_kept(std::uint64_t draw) {
  const std::optional<solver::Verdict> verdict = ascent_->verdict();
  if (!verdict) return true;
  if (sampled_.holds(draw)) block_->fault_sample.push_back({draw, *verdict});
  if (campaign_.accepts(*verdict)) return true;
  --block_->accepted;
  block_->turn_down(draw, *verdict);
  return false;
}

schema::UnitRecord Ascents::take() {
  assert(finished());
  schema::UnitRecord block = std::move(*block_);
  block_.reset();
  return block;
}

}  // namespace misalign::search
