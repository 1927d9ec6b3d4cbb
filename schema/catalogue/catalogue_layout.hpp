// Lists the tables, views, triggers and indexes of a catalogue in each schema version. A file with
// any others is refused: its rows may not mean what they seem to.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

namespace misalign::schema {

/// Compares the file's schema with that of a new catalogue of that version, or of one that was
/// migrated to it. Comments and blanks do not count; statistics of ANALYZE are allowed. Executes
/// nothing of the file's schema. UserError (bad_input) names differences; an unknown version is the
/// caller's error.
void check_layout(SQLite::Database& database, int version, const std::string& path);

}  // namespace misalign::schema
