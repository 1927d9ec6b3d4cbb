// Checks the journal and the log beside a database before SQLite acts on them.
#pragma once

#include <string>

namespace misalign::schema {

/// UserError (bad_input) if a journal, a log or the log's index beside a database is no regular
/// file (SQLite would wait for a named pipe for ever), or if the journal ends with the name of a
/// super-journal, for a transaction over several files: then SQLite opens and deletes that file,
/// wherever it is, and no catalogue was ever part of such a transaction. SQLite looks beside the
/// file that a link leads to, and so does this.
void check_journals(const std::string& database_path);

}  // namespace misalign::schema
