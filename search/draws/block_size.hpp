// The number of sheets of a model that are judged together.
#pragma once

#include <cstdint>

#include "solver/model/model.hpp"

namespace misalign::search {

/// At most: what they need stays within a few megabytes.
std::uint64_t largest_block(const solver::Model& model);

/// As many as take less than about a tenth of a second: who waits for their end must not wait long.
/// Starts with one.
class BlockSize {
 public:
  explicit BlockSize(std::uint64_t most) : most_(most) {}

  std::uint64_t now() const { return now_; }
  /// What the last ones took.
  void took(double seconds);

 private:
  std::uint64_t most_, now_ = 1;
};

}  // namespace misalign::search
