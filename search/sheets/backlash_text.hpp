// A study of backlash, as text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/play/backlash.hpp"

namespace misalign::search {

/// A sheet's name, "draw 17", its backlash, and the threshold of its campaign, if it has one.
struct NamedBacklash {
  std::string name;
  solver::Backlash backlash;
  std::optional<double> threshold_deg;
};

/// Text of one sheet; the result comes last.
std::string backlash_text(const NamedBacklash& named);
/// A line for each of several, the one that takes the most backlash last.
std::string backlashes_text(std::vector<NamedBacklash> several);
}  // namespace misalign::search
