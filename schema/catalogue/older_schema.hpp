// Reads catalogues of older schemas unchanged.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

namespace misalign::schema {

/// Defines the present views and tables over those of an older catalogue, for this connection
/// alone: `candidates` with null in later columns, `yield` from the campaign's threshold, `ascent`
/// without rows. Writes nothing; main.NAME remains the file's table. Must precede the ban on making
/// views. Throws SQLite::Exception.
void show_as_of_today(SQLite::Database& database, int version);

}  // namespace misalign::schema
