// Corrects how SQLite handles interrupted and failing calls of the file system.
#pragma once

namespace misalign::schema {

/// Guards SQLite's system calls from now on: they end even if they are always interrupted, and an
/// unreadable disk (EIO) is not taken for a damaged file (SQLITE_CORRUPT). Affects the whole
/// process; another call guards calls that were put in meanwhile.
void guard_file_calls();

}  // namespace misalign::schema
