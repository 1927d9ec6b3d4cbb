// The tables, views, triggers and indexes that a catalogue has in each schema version. A file with
// any others is refused: its rows need not mean what they seem to.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

namespace misalign::schema {

/// Compares the file's schema with what the program writes in that version, in a new catalogue or
/// one that was brought up from an older version; comments and blanks do not count, and statistics
/// that ANALYZE left may be there. Nothing of the file's schema is run. UserError (bad_input) that
/// names what is foreign, other or missing; foreign is the caller's, who knows the version.
void check_layout(SQLite::Database& database, int version, const std::string& path);

}  // namespace misalign::schema
