// Catalogues of older schemas, read as they are.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

namespace misalign::schema {

/// Lays today's view `candidates` over the one of a catalogue of this older version, for this
/// connection alone: columns that came later are null in it, and nothing is written. Before the
/// connection is forbidden to make views. Throws SQLite::Exception.
void show_as_of_today(SQLite::Database& database, int version);

}  // namespace misalign::schema
