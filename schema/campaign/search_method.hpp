// The part "search" of a campaign: plain draws, populations that climb (splitting), or draws, or
// sheets of populations, that are made better (optimise).
#pragma once

#include "schema/campaign/optimisation.hpp"
#include "schema/campaign/splitting.hpp"

namespace misalign::schema {

/// None: plain draws. Both: the sheets that populations find are made better.
struct SearchMethod {
  std::optional<Splitting> splitting;
  std::optional<Optimisation> optimisation;

  /// Whether a candidate's sheet is another than its number's draw, so that it is known by its
  /// stored displacements alone, and its hash is part of the digest.
  bool stores_sheets() const { return splitting || optimisation; }
  /// Whether a sheet that is met again is no other candidate; of ascents every start has its end.
  bool has_each_once() const { return splitting && !optimisation; }
};

/// Reads it where threshold and samples are known.
SearchMethod read_search(ObjectReader reader, double threshold_deg, double sample_deg);

/// Every key of that part.
Json search_json(const SearchMethod& method);

}  // namespace misalign::schema
