// Checks the journal and the log beside a database before SQLite acts on them.
#pragma once

#include <string>

namespace misalign::schema {

/// Checks the journals of a database. UserError (bad_input) if a journal, a log or the log's index
/// is no regular file, since SQLite would wait for a named pipe for ever; or if the journal ends
/// with the name of a super-journal, for a transaction over several files. SQLite would open and
/// delete that file, wherever it is, and no catalogue is ever part of such a transaction. Like
/// SQLite, this follows links.
void check_journals(const std::string& database_path);

}  // namespace misalign::schema
