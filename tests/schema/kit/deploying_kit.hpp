// A sheet that deploys, to make kits of plates of.
#pragma once

#include "schema/pattern/pattern_file.hpp"
#include "tests/solver/own_sheet.hpp"

namespace misalign::schema {

/// The sheet of Table 1, which deploys from 156 degrees.
struct DeployingKit {
  const Pattern pattern = read_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/table1.json");
  const solver::OwnSheet own{pattern.base, pattern.shifts_mm};
  const solver::Sheet& sheet = own.sheet;
};

}  // namespace misalign::schema
