// Counts the rows that break a CHECK of their table. SQLite leaves CHECKs out of a file that is
// opened only to be read, and its integrity_check then passes over them.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <vector>

#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// A finding for each CHECK that rows break, but of pieces: one that is no use is made again.
/// SQLite::Exception if they cannot be read.
std::vector<Finding> check_constraints(SQLite::Database& database);

}  // namespace misalign::schema
