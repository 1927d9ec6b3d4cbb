// Designs sheets for a wish: makes sheets, chooses their free numbers, and optimises the best.
#pragma once

#include "search/designs/design_try.hpp"
#include "search/designs/sheet_sources.hpp"

namespace misalign::search {

struct DesignerOptions {
  SourceOptions sources;
  std::uint64_t trials = 1000;  ///< miscut copies, and settlings of loose joints
  int jobs = 1;                 ///< threads; the result does not depend on them
  std::string log_path;         ///< file of finished steps; empty: none
};

/// Returns all designs that were tried, the best first: those that meet all requirements by their
/// least reserve, then those nearest to that. UserError as sheet_sources and DesignLog.
std::vector<DesignTry> designs_for(const schema::Wish& wish, const DesignerOptions& options);

}  // namespace misalign::search
