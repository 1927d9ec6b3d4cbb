#include "schema/catalogue/catalogue_layout.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include "schema/catalogue/connection.hpp"
#include "schema/catalogue/sql_tokens.hpp"
#include "schema/files/carried_files.hpp"
#include "schema/files/printable.hpp"
#include "schema/files/user_error.hpp"

namespace misalign::schema {
namespace {

// A row of sqlite_schema.
struct Made {
  std::string table;  // its table
  SqlTokens sql;      // none for an index that a key makes
};
bool same(const Made& a, const Made& b) {
  return a.table == b.table && a.sql.tokens == b.sql.tokens && !a.sql.is_open && !b.sql.is_open;
}

using TypeAndName = std::pair<std::string, std::string>;
struct Layout {
  std::map<TypeAndName, Made> made;
  std::set<TypeAndName> twice;  // SQLite allows duplicate rows without a definition
};

Layout layout_of(SQLite::Database& database) {
  Layout layout;
  SQLite::Statement row(database, "SELECT type, name, tbl_name, sql FROM sqlite_schema");
  while (row.executeStep()) {
    const TypeAndName key{row.getColumn(0).getString(), row.getColumn(1).getString()};
    Made made{row.getColumn(2).getString(), sql_tokens(row.getColumn(3).getString())};
    if (!layout.made.try_emplace(key, std::move(made)).second) layout.twice.insert(key);
  }
  return layout;
}

// Origin of a catalogue. Its layout is that of a catalogue made in version 7 and migrated, whatever
// its version. The only exception was made in version 1 and migrated by release 1.0.0: a column
// that was added to its runs has a default. (If a migration cannot make what catalogue.sql makes,
// that must be kept in versions/ and named here.) Comments do not count.
enum class MadeIn { version_7, version_1 };

std::string first_layout(MadeIn made_in) {
  std::string sql = carried_text("schema/versions/7.sql");
  if (made_in == MadeIn::version_7) return sql;
  const std::string column = "schema_version INTEGER NOT NULL";
  assert(sql.find(column) != std::string::npos);
  return sql.insert(sql.find(column) + column.size(), " DEFAULT 1");
}

// Returns the layout of a catalogue of that origin and version, computed once.
const Layout& layout_of(MadeIn made_in, int version) {
  static std::map<std::pair<MadeIn, int>, Layout> layouts;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const auto known = layouts.find({made_in, version});
  if (known != layouts.end()) return known->second;
  const auto database = connect_to_memory();
  database->exec(first_layout(made_in));
  for (int next = 8; next <= version; ++next)
    database->exec(carried_text("schema/migrations/" + std::to_string(next) + ".sql"));
  return layouts[{made_in, version}] = layout_of(*database);
}

// Returns whether a table comes from ANALYZE. Its rows may change the plan of a statement, but no
// result.
bool is_statistics(const std::string& name, const Made& made) {
  static const std::map<std::string, std::vector<std::string>> kTables = {
      {"sqlite_stat1", sql_tokens("CREATE TABLE sqlite_stat1(tbl,idx,stat)").tokens},
      {"sqlite_stat4",
       sql_tokens("CREATE TABLE sqlite_stat4(tbl,idx,neq,nlt,ndlt,sample)").tokens}};
  const auto at = kTables.find(name);
  return at != kTables.end() && at->second == made.sql.tokens && !made.sql.is_open;
}

// Returns the definitions between the commas of a table's outer brackets: columns and conditions.
std::vector<std::string> definitions_of(const std::vector<std::string>& tokens) {
  std::vector<std::string> definitions;
  int depth = 0;
  for (const std::string& token : tokens) {
    depth += token == "(" ? 1 : token == ")" ? -1 : 0;
    if (depth == 0) continue;
    if (depth == 1 && (token == "(" || token == ",")) {
      definitions.emplace_back();
    } else {
      definitions.back() += (definitions.back().empty() ? "" : " ") + token;
    }
  }
  return definitions;
}

std::string shown_name(const std::string& name) { return printable(utf8(shortened(name, 40))); }

// Adds the columns in which two tables differ.
void add_columns(const std::string& table, const Made& found, const Made& wanted,
                 std::vector<std::string>& differences) {
  // Maps a definition by its first word, the column's name.
  const auto named = [](const std::vector<std::string>& definitions) {
    std::map<std::string, std::set<std::string>> all;
    for (const std::string& text : definitions) all[text.substr(0, text.find(' '))].insert(text);
    return all;
  };
  const auto theirs = named(definitions_of(found.sql.tokens));
  const auto ours = named(definitions_of(wanted.sql.tokens));
  const std::size_t before = differences.size();
  const auto add = [&](const std::string& column, const char* what) {
    differences.push_back("column " + shown_name(column) + " of table " + table + " is " + what);
  };
  for (const auto& [column, definitions] : theirs) {
    const auto at = ours.find(column);
    if (at == ours.end()) {
      add(column, "foreign");
    } else if (at->second != definitions) {
      add(column, "another");
    }
  }
  for (const auto& [column, definitions] : ours) {
    if (!theirs.contains(column)) add(column, "missing");
  }
  if (differences.size() == before) differences.push_back("table " + table + " is another");
}

// "view spy is foreign", "column goal_end of table campaign is another"
std::vector<std::string> differences_of(const Layout& found, const Layout& wanted) {
  std::vector<std::string> differences;
  for (const auto& [type, name] : found.twice) {
    differences.push_back(shown_name(type) + " " + shown_name(name) + " occurs twice");
  }
  for (const auto& [key, made] : found.made) {
    const auto& [type, name] = key;
    const std::string what = shown_name(type) + " " + shown_name(name);
    const auto at = wanted.made.find(key);
    if (at == wanted.made.end()) {
      if (is_statistics(name, made)) continue;
      const std::string on = made.table == name ? "" : " on " + shown_name(made.table);
      differences.push_back(what + on + " is foreign");
    } else if (!same(made, at->second)) {
      type == "table" ? add_columns(name, made, at->second, differences)
                      : differences.push_back(what + " is another");
    }
  }
  for (const auto& [key, made] : wanted.made) {
    if (!found.made.contains(key))
      differences.push_back(key.first + " " + key.second + " is missing");
  }
  return differences;
}

UserError not_as_made(const std::string& path, const std::vector<std::string>& differences) {
  constexpr std::size_t kMost = 5;
  std::string all;
  for (std::size_t k = 0; k < std::min(kMost, differences.size()); ++k) {
    all += (k > 0 ? ", " : "") + differences[k];
  }
  if (differences.size() > kMost) {
    all += ", and " + std::to_string(differences.size() - kMost) + " more";
  }
  return UserError(Cause::bad_input, path + ": is not laid out as misalign lays out a catalogue (" +
                                         all +
                                         "); undo that with the sqlite3 shell if you did it, "
                                         "otherwise put a backup in its place");
}

}  // namespace

void check_layout(SQLite::Database& database, int version, const std::string& path) {
  const Layout found = layout_of(database);
  std::vector<std::string> least;
  for (const MadeIn made_in : {MadeIn::version_7, MadeIn::version_1}) {
    std::vector<std::string> differences = differences_of(found, layout_of(made_in, version));
    if (differences.empty()) return;
    if (least.empty() || differences.size() < least.size()) least = std::move(differences);
  }
  throw not_as_made(path, least);
}

}  // namespace misalign::schema
