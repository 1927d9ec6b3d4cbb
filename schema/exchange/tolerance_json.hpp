// A study of tolerance, as JSON.
#pragma once

#include "schema/campaign/share_interval.hpp"
#include "schema/files/input.hpp"
#include "solver/design/tolerance.hpp"

namespace misalign::schema {

inline ShareOfTrials share_of(std::uint64_t hits, const solver::MiscutCopies& copies) {
  return share_of(hits, copies.undecided, copies.trials);
}

/// Without the sheet's name.
Json tolerance_json(const solver::Tolerance& tolerance);

}  // namespace misalign::schema
