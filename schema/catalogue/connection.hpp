// Connections to SQLite that are safe for a file of any origin.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <memory>
#include <string>

namespace misalign::schema {

enum class Access {
  read,  ///< statements of anybody's; nothing can be written, no other file touched
  write  ///< our own statements; creates the file if there is none
};

/// The name under which SQLite opens a file and nothing but that file: Debian's takes "file:a?mode=
/// memory" for a URI, and ":memory:" is no file anywhere.
std::string plain_file_name(const std::string& path);

/// The only way to open a database here. Extensions and fts3_tokenizer are off, functions are those
/// of a list, no virtual table can be made, sizes have limits; and a reader's schema may call
/// nothing that SQLite does not know to be harmless, until trust_schema. Looks at the file's
/// journals, and not yet at the file. Throws SQLite::Exception, and a UserError as from
/// check_journals.
std::unique_ptr<SQLite::Database> connect(const std::string& path, Access access);

/// An empty database in memory, for tables and views of our own.
std::unique_ptr<SQLite::Database> connect_to_memory();

/// Lifts the reader's ban for our own statements, such as temporary views, while `work` runs; it is
/// there again afterwards, also where that throws.
void as_our_own(SQLite::Database& reader, const std::function<void()>& work);

/// Lets views and checks call JSON functions, which SQLite 3.40 takes for harmful
/// there: once the schema is known to be ours.
void trust_schema(SQLite::Database& database);

}  // namespace misalign::schema
