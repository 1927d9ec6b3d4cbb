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

// At one more sheet. A candidate that is as it is kept now; mostly none.
schema::Candidate* Ascents::look() {
  schema::Candidate& candidate = block_->candidates[next_];
  if (!one_) {
    one_ = ascend_(campaign_, model_, std::move(candidate));
  } else if (!one_->finished()) {
    one_->advance();
  }
  if (!one_->finished()) return nullptr;
  candidate = one_->take();
  one_.reset();
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
