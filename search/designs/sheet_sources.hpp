// Makes sheets for a wish: its own, constructed, drawn, climbed to and shaped ones.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "schema/pattern/wish.hpp"

namespace misalign::search {

/// A sheet as a pattern file with the wish's design, or the reason why there is none.
struct MadeSheet {
  std::string how;  ///< "constructed, shifts up to 4 mm, for 120°"
  schema::Json pattern;
  std::string why;  ///< empty with a pattern
};

/// Makes sheets of one base in one way; throws no UserError.
struct SheetSource {
  std::string how;
  std::string base;  ///< fingerprint of the base, its design and its target
  std::function<std::vector<MadeSheet>()> make;
};

struct SourceOptions {
  std::uint64_t draws = 200000;  ///< largest number of draws of each base; 0: none
  std::uint64_t seed = 1;
};

/// The sources of all bases: every choice of holes, and every angle of use, the largest first.
/// UserError (bad_input) where the pattern has a fault, or no angle of use is named.
std::vector<SheetSource> sheet_sources(const schema::Wish& wish, const SourceOptions& options);

}  // namespace misalign::search
