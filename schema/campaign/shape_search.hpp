// Defines the search method "shape": each draw is the start of a descent to a sheet that has the
// campaign's target on its way.
#pragma once

#include <vector>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Settings that, beside target and acceptance, determine the end of a start. The member
/// initializers are released defaults and never change.
struct ShapeSearch {
  double shape_max_mm = 1;                 ///< largest distance of an end that is accepted
  std::vector<double> shift_weights = {};  ///< each draw has one; empty: that of ShapeOptions
  std::uint32_t turned_diagonals = 0;      ///< number that each draw turns

  bool operator==(const ShapeSearch&) const = default;
};

/// Reads the keys of shape in the part "search" of a campaign.
ShapeSearch read_shape_search(ObjectReader& reader);

/// Returns every key of shape alone.
Json shape_search_json(const ShapeSearch& search);

}  // namespace misalign::schema
