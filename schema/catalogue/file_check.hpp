// Checks a catalogue's file as SQLite's: its integrity, foreign keys and CHECKs.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <vector>

#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// A finding for each CHECK that rows break, but of `piece`, whose rows that are no use are only
/// made again; and what SQLite finds. SQLite::Exception: unreadable rows. UserError (failure) if
/// the disk does not give them.
std::vector<Finding> check_file(SQLite::Database& database);

}  // namespace misalign::schema
