// Opens connections to SQLite that are safe for a file of any origin.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <memory>
#include <string>

namespace misalign::schema {

enum class Access {
  read,  ///< statements of any origin; nothing is written, no other file touched
  write  ///< the program's own statements; creates the file if there is none
};

/// Returns a name under which SQLite opens this file and no other: Debian's takes "file:a?mode=
/// memory" for a URI, and ":memory:" is never a file.
std::string plain_file_name(const std::string& path);

/// Opens a database; all code must use this. Extensions and fts3_tokenizer are off, functions are
/// those of a list, virtual tables cannot be made, sizes have limits. A reader's schema may call
/// only functions that SQLite knows to be harmless, until trust_schema. Checks the file's journals,
/// but not the file. Throws SQLite::Exception, and a UserError as from check_journals.
std::unique_ptr<SQLite::Database> connect(const std::string& path, Access access);

/// Opens an empty database in memory, for temporary tables and views.
std::unique_ptr<SQLite::Database> connect_to_memory();

/// Lifts the reader's restrictions for the program's own statements, such as temporary views, while
/// `work` runs, also if it throws.
void as_our_own(SQLite::Database& reader, const std::function<void()>& work);

/// Allows JSON functions in views and checks, which SQLite 3.40 takes for harmful, once the schema
/// is known to be the program's.
void trust_schema(SQLite::Database& database);

}  // namespace misalign::schema
