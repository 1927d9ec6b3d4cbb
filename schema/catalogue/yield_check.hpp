// Checks a catalogue's yields: counts, shares and intervals must agree with each other.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <vector>

#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// Every yield: its draw is a candidate, its counts add up, and its share and interval are theirs.
/// Throws SQLite::Exception.
std::vector<Finding> check_yields(SQLite::Database& database);

}  // namespace misalign::schema
