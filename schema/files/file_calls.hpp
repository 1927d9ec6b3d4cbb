// Corrects how SQLite handles interrupted and failing calls of the file system.
#pragma once

namespace misalign::schema {

/// From now on SQLite's calls end though they are interrupted for ever, and a disk that cannot be
/// read (EIO) is not taken for a damaged file: SQLite would say SQLITE_CORRUPT. For the whole
/// process; may be called again, and then stands before what was put there meanwhile.
void guard_file_calls();

}  // namespace misalign::schema
