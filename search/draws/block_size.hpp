// Chooses the number of sheets of a model that are judged together.
#pragma once

#include <cstdint>

#include "solver/model/model.hpp"

namespace misalign::search {

/// Returns the largest block, which needs a few megabytes.
std::uint64_t largest_block(const solver::Model& model);

/// Adapts the block to less than about a tenth of a second, so that nobody waits long for its end.
/// Starts with one sheet.
class BlockSize {
 public:
  explicit BlockSize(std::uint64_t most) : most_(most) {}

  std::uint64_t now() const { return now_; }
  /// Takes the time of the last block.
  void took(double seconds);

 private:
  std::uint64_t most_, now_ = 1;
};

}  // namespace misalign::search
