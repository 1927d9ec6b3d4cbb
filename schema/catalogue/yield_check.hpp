// Whether the yields that a catalogue keeps can be what was counted.
#pragma once

#include "schema/catalogue/ledger_check.hpp"

namespace misalign::schema {

/// Every yield: its draw is a candidate, its counts add up, and its share and interval are theirs.
/// Throws SQLite::Exception.
std::vector<Finding> check_yields(SQLite::Database& database);

}  // namespace misalign::schema
