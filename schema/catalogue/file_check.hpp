// Checks a catalogue's file as SQLite's: its integrity, foreign keys and CHECKs.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <vector>

#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// Returns a finding for each CHECK that rows break, and SQLite's own findings. Rows of `piece` are
/// left out: unusable ones are only computed again. SQLite::Exception: unreadable rows. UserError
/// (failure) if the disk fails.
std::vector<Finding> check_file(SQLite::Database& database);

}  // namespace misalign::schema
