// Reads the file of `misalign stress` for the report's page.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "schema/pattern/pattern_file.hpp"

namespace misalign::schema {

struct StressResult {
  std::string path;
  /// The sheet: {"draw", "campaign"} or {"pattern", "sheet"}.
  Json whose;
  /// [row, column] and largest stress; 0 where no node lies outside the discs.
  std::vector<std::pair<std::array<int, 2>, double>> panels_mpa;
  Json shown;  ///< the other data of the page, curves in base64
};

/// Reads NAME-stress.json of `misalign stress`. UserError (bad_input), one sentence, if it is no
/// such file.
StressResult read_stress_result(const std::string& path);

/// The page's data: `shown`, and "panels_mpa" in the order of sheet_json's panels. UserError
/// (bad_input) if the sheet has other panels.
Json stress_shown_json(const StressResult& result, const Pattern& base);

}  // namespace misalign::schema
