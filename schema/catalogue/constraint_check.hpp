// Counts rows that break a CHECK of their table: SQLite leaves CHECKs out of a file that is only
// read, and its integrity_check passes over them. Pieces that are no use are only made again.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <vector>

#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// A finding for each CHECK that rows break, but of `piece`. SQLite::Exception: unreadable rows.
std::vector<Finding> check_constraints(SQLite::Database& database);

}  // namespace misalign::schema
