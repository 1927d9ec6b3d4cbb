#include "search/draws/ascents.hpp"

#include <cassert>
#include <utility>

namespace misalign::search {

void Ascents::begin(schema::UnitRecord block) {
  block_ = std::move(block);
  next_ = 0;
}

schema::Candidate* Ascents::advance() {
  if (finished()) return nullptr;
  schema::Candidate& candidate = block_->candidates[next_];
  if (!one_) {
    one_ = begin_(std::move(candidate));
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
