// Defines the part "search" of a campaign: plain draws, populations (splitting), ascents from draws
// or sheets of populations (optimise), or descents from draws to a target (shape).
#pragma once

#include "schema/campaign/optimisation.hpp"
#include "schema/campaign/shape_search.hpp"
#include "schema/campaign/splitting.hpp"

namespace misalign::schema {

/// None: plain draws. The first two: ascents from sheets of populations.
struct SearchMethod {
  std::optional<Splitting> splitting;
  std::optional<Optimisation> optimisation;
  std::optional<ShapeSearch> shape;

  /// Returns whether candidates are ends of ascents or descents, with their records.
  bool has_ends() const { return optimisation || shape; }
  /// Returns whether a candidate's sheet differs from its number's draw, so that only its stored
  /// displacements determine it, and its hash is part of the digest.
  bool stores_sheets() const { return splitting || has_ends(); }
  /// Returns whether a sheet is only one candidate however often it is found; optima are kept for
  /// every start.
  bool has_each_once() const { return splitting && !optimisation; }
};

/// Reads the search method; threshold and samples must be known.
SearchMethod read_search(ObjectReader reader, double threshold_deg, double sample_deg);

/// Returns every key of that part.
Json search_json(const SearchMethod& method);

}  // namespace misalign::schema
