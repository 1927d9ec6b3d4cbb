// Reads the file of `misalign stress` again, for the report's page.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "schema/pattern/pattern_file.hpp"

namespace misalign::schema {

struct StressResult {
  std::string path;
  /// {"draw", "campaign"} or {"pattern", "sheet"}: whose it is.
  Json whose;
  /// Of each [row, column] the largest stress; 0 where no node lies outside the discs.
  std::vector<std::pair<std::array<int, 2>, double>> panels_mpa;
  Json shown;  ///< the rest, as the page has it: curves in base64
};

/// NAME-stress.json of `misalign stress`. UserError (bad_input), one sentence, where it is no such
/// file.
StressResult read_stress_result(const std::string& path);

/// For the page: "panels_mpa" in the order of sheet_json's panels, and the rest. UserError
/// (bad_input) where the sheet has other panels.
Json stress_shown_json(const StressResult& result, const Pattern& base);

}  // namespace misalign::schema
