#include "schema/catalogue/connection.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string_view>

#include "schema/catalogue/journal_check.hpp"
#include "schema/catalogue/study_table.hpp"
#include "schema/files/file_calls.hpp"

namespace misalign::schema {
namespace {

constexpr int kBusyTimeout_ms = 10000;

// Functions of SQLite 3.40 and later for queries and views: numbers in, numbers out. Deliberately
// missing: load_extension, fts3_tokenizer, those of full-text and R-tree indexes, sqlite_log.
const std::set<std::string_view>& known_functions() {
  static const std::set<std::string_view> names = {
      // core
      "abs", "char", "coalesce", "concat", "concat_ws", "format", "glob", "hex", "if", "ifnull",
      "iif", "instr", "length", "like", "likelihood", "likely", "lower", "ltrim", "max", "min",
      "nullif", "octet_length", "printf", "quote", "random", "randomblob", "replace", "round",
      "rtrim", "sign", "sqlite_version", "substr", "substring", "trim", "typeof", "unhex",
      "unicode", "unlikely", "upper", "zeroblob",
      // aggregates and windows
      "avg", "count", "cume_dist", "dense_rank", "first_value", "group_concat", "lag", "last_value",
      "lead", "median", "nth_value", "ntile", "percent_rank", "percentile", "percentile_cont",
      "percentile_disc", "rank", "row_number", "string_agg", "sum", "total",
      // mathematics
      "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "ceil", "ceiling", "cos", "cosh",
      "degrees", "exp", "floor", "ln", "log", "log10", "log2", "mod", "pi", "pow", "power",
      "radians", "sin", "sinh", "sqrt", "tan", "tanh", "trunc",
      // dates
      "current_date", "current_time", "current_timestamp", "date", "datetime", "julianday",
      "strftime", "time", "timediff", "unixepoch",
      // JSON
      "->", "->>", "json", "json_array", "json_array_length", "json_error_position", "json_extract",
      "json_group_array", "json_group_object", "json_insert", "json_object", "json_patch",
      "json_pretty", "json_quote", "json_remove", "json_replace", "json_set", "json_type",
      "json_valid"};
  return names;
}

// Pragmas that only read, with any argument.
constexpr std::array<std::string_view, 10> kLookingPragmas = {
    "table_info",  "table_xinfo",      "table_list",        "index_list",      "index_info",
    "index_xinfo", "foreign_key_list", "foreign_key_check", "integrity_check", "quick_check"};
// Pragmas that only read when they have no argument.
constexpr std::array<std::string_view, 5> kAskedPragmas = {
    "user_version", "application_id", "page_count", "page_size", "freelist_count"};

template <std::size_t count>
bool is_among(const std::array<std::string_view, count>& names, const char* name) {
  return name && std::find(names.begin(), names.end(), name) != names.end();
}

bool may_call(const char* function) {
  return function && (known_functions().contains(function) || study_column(function));
}

// Built-in virtual tables of SQLite, such as dbstat and fts3tokenize.
const std::set<std::string, std::less<>>& modules() {
  static const auto names = [] {
    std::set<std::string, std::less<>> found;
    SQLite::Database memory(":memory:");
    SQLite::Statement rows(memory, "SELECT lower(name) FROM pragma_module_list");
    while (rows.executeStep()) found.insert(rows.getColumn(0).getString());
    return found;
  }();
  return names;
}

// Returns whether a table may be read. Tables of a JSON text or of a pragma may, and so may all
// names that are neither SQLite's nor a module's: tables of the file, whose layout was compared
// before, and names of a query (WITH).
bool may_read(const char* table) {
  std::string name = table ? table : "";
  for (char& letter : name) {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  constexpr std::string_view kPragma = "pragma_";
  if (name.starts_with(kPragma)) {
    const std::string pragma = name.substr(kPragma.size());
    return is_among(kLookingPragmas, pragma.c_str()) || is_among(kAskedPragmas, pragma.c_str());
  }
  constexpr std::array<std::string_view, 6> kOthers = {
      "sqlite_schema", "sqlite_master", "sqlite_stat1", "sqlite_stat4", "json_each", "json_tree"};
  return is_among(kOthers, name.c_str()) ||
         (!name.starts_with("sqlite_") && !modules().contains(name));
}

// Allows reading, and nothing that could touch another file.
int authorize_reading(void*, int action, const char* first, const char* second, const char*,
                      const char*) {
  switch (action) {
    case SQLITE_SELECT:
    case SQLITE_RECURSIVE:
    case SQLITE_TRANSACTION:
      return SQLITE_OK;
    case SQLITE_READ:
      return may_read(first) ? SQLITE_OK : SQLITE_DENY;
    case SQLITE_FUNCTION:  // two arguments: a null and the function's name
      return may_call(second) ? SQLITE_OK : SQLITE_DENY;
    case SQLITE_UPDATE:  // so SQLite asks before it makes json_each; nobody can do it (defensive)
      return first == std::string_view("sqlite_master") ? SQLITE_OK : SQLITE_DENY;
    case SQLITE_PRAGMA:
      return is_among(kLookingPragmas, first) || (is_among(kAskedPragmas, first) && !second)
                 ? SQLITE_OK
                 : SQLITE_DENY;
    default:
      return SQLITE_DENY;
  }
}

// Allows the program's own statements, and those of triggers and checks.
int authorize_writing(void*, int action, const char*, const char* second, const char*,
                      const char*) {
  switch (action) {
    case SQLITE_FUNCTION:
      return may_call(second) ? SQLITE_OK : SQLITE_DENY;
    case SQLITE_CREATE_VTABLE:
    case SQLITE_DROP_VTABLE:
      return SQLITE_DENY;
    default:
      return SQLITE_OK;
  }
}

struct Limit {
  int id, most;
};

// The largest text of a catalogue is its configuration: with a mesh of 10,000 panels it has 2 MB.
constexpr Limit kLimits[] = {
    {SQLITE_LIMIT_LENGTH, 64 << 20},     {SQLITE_LIMIT_SQL_LENGTH, 1 << 20},
    {SQLITE_LIMIT_COLUMN, 500},          {SQLITE_LIMIT_EXPR_DEPTH, 500},
    {SQLITE_LIMIT_COMPOUND_SELECT, 200}, {SQLITE_LIMIT_VDBE_OP, 1 << 20},
    {SQLITE_LIMIT_FUNCTION_ARG, 100},    {SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 1000},
    {SQLITE_LIMIT_VARIABLE_NUMBER, 200}, {SQLITE_LIMIT_TRIGGER_DEPTH, 10},
    {SQLITE_LIMIT_WORKER_THREADS, 0}};

void make_safe(SQLite::Database& database, Access access) {
  sqlite3* handle = database.getHandle();
  const auto set = [&](int option, int value) {
    if (sqlite3_db_config(handle, option, value, nullptr) != SQLITE_OK) {
      throw SQLite::Exception("SQLite does not know option " + std::to_string(option));
    }
  };
  set(SQLITE_DBCONFIG_ENABLE_FTS3_TOKENIZER, 0);
  set(SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0);
  set(SQLITE_DBCONFIG_DEFENSIVE, 1);
  set(SQLITE_DBCONFIG_DQS_DML, 0);  // a misspelt column is an error, not a text
  set(SQLITE_DBCONFIG_DQS_DDL, 0);
  set(SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0);
  if (access == Access::write) {
    trust_schema(database);  // or SQLite 3.40 could not even load the checks of a catalogue
  } else {
    set(SQLITE_DBCONFIG_ENABLE_TRIGGER, 0);
  }
  for (const Limit& limit : kLimits) sqlite3_limit(handle, limit.id, limit.most);
  // VACUUM INTO attaches one database.
  sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, access == Access::read ? 0 : 1);
  database.exec("PRAGMA cell_size_check = ON");  // damaged pages are noticed when they are read
  database.exec("PRAGMA mmap_size = 0");         // a file that shrinks would be a bus error
  sqlite3_set_authorizer(handle, access == Access::read ? authorize_reading : authorize_writing,
                         nullptr);
}

}  // namespace

std::string plain_file_name(const std::string& path) {
  const bool is_taken_for_more = path.empty() || path[0] == ':' || path.starts_with("file:");
  return is_taken_for_more ? "./" + path : path;
}

std::unique_ptr<SQLite::Database> connect(const std::string& path, Access access) {
  guard_file_calls();
  check_journals(path);
  auto database = std::make_unique<SQLite::Database>(
      plain_file_name(path),
      access == Access::read ? SQLite::OPEN_READONLY : SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
      kBusyTimeout_ms);
  make_safe(*database, access);
  return database;
}

std::unique_ptr<SQLite::Database> connect_to_memory() {
  auto database = std::make_unique<SQLite::Database>(
      ":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE | SQLite::OPEN_MEMORY);
  make_safe(*database, Access::write);
  return database;
}

void as_our_own(SQLite::Database& reader, const std::function<void()>& work) {
  class Lifted {
   public:
    explicit Lifted(sqlite3* handle) : handle_(handle) {
      sqlite3_set_authorizer(handle_, nullptr, nullptr);
    }
    ~Lifted() { sqlite3_set_authorizer(handle_, authorize_reading, nullptr); }
    Lifted(const Lifted&) = delete;
    Lifted& operator=(const Lifted&) = delete;

   private:
    sqlite3* const handle_;
  };
  const Lifted ban(reader.getHandle());
  work();
}

void trust_schema(SQLite::Database& database) {
  static const bool json_is_innocuous =
      (SQLite::Database(":memory:")
           .execAndGet("SELECT flags FROM pragma_function_list WHERE name = 'json_valid'")
           .getInt() &
       SQLITE_INNOCUOUS) != 0;
  if (json_is_innocuous) return;
  sqlite3_db_config(database.getHandle(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 1, nullptr);
}

}  // namespace misalign::schema
