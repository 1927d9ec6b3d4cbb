#include "search/draws/ascents.hpp"

#include <cassert>
#include <utility>

#include "search/terminal/stopwatch.hpp"

namespace misalign::search {

void Ascents::begin(schema::UnitRecord block) {
  block_ = std::move(block);
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
  ascent_.reset();
  ++next_;
  return &candidate;
}

schema::UnitRecord Ascents::take() {
  assert(finished());
  schema::UnitRecord block = std::move(*block_);
  block_.reset();
  return block;
}

}  // namespace misalign::search
