// Chooses items spread evenly over a list.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace misalign::search {

/// Returns `wanted` of all items, spread evenly; all where none is given.
template <class Item>
std::vector<Item> spread(const std::vector<Item>& all, std::optional<std::uint64_t> wanted) {
  const std::uint64_t chosen = std::min<std::uint64_t>(wanted.value_or(all.size()), all.size());
  std::vector<Item> some;
  for (std::uint64_t k = 0; k < chosen; ++k) some.push_back(all[k * all.size() / chosen]);
  return some;
}

}  // namespace misalign::search
