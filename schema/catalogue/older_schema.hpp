// Catalogues of older schemas, read as they are.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

namespace misalign::schema {

/// Lays today's views, and tables as today's, over those of a catalogue of this older version, for
/// this connection alone: `candidates` with null in columns that came later, `yield` from the
/// campaign's threshold, `ascent` without rows. Nothing is written; main.NAME is what the file
/// holds. Before the connection is forbidden to make views. Throws SQLite::Exception.
void show_as_of_today(SQLite::Database& database, int version);

}  // namespace misalign::schema
