// Catalogues as they should not be.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "tests/stress/mutations.hpp"

namespace misalign::stress {

/// An SQLite file in memory.
class MemoryDatabase {
 public:
  explicit MemoryDatabase(const std::string& bytes)
      : database_(":memory:", SQLite::OPEN_READWRITE) {
    auto* copy = static_cast<unsigned char*>(sqlite3_malloc64(bytes.size()));
    std::memcpy(copy, bytes.data(), bytes.size());
    const auto size = static_cast<sqlite3_int64>(bytes.size());
    sqlite3_deserialize(database_.getHandle(), "main", copy, size, size,
                        SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_RESIZEABLE);
  }

  /// Whether it could be done.
  bool run(const std::string& sql) { return database_.tryExec(sql) == SQLITE_OK; }
  std::vector<std::string> texts(const std::string& sql) {
    std::vector<std::string> all;
    SQLite::Statement rows(database_, sql);
    while (rows.executeStep()) all.push_back(rows.getColumn(0).getString());
    return all;
  }
  std::string bytes() {
    sqlite3_int64 size = 0;
    unsigned char* copy = sqlite3_serialize(database_.getHandle(), "main", &size, 0);
    std::string all(reinterpret_cast<const char*>(copy), static_cast<std::size_t>(size));
    sqlite3_free(copy);
    return all;
  }

 private:
  SQLite::Database database_;
};

/// Catalogues with damage: of the bytes, as a disk or a copy that broke off could leave them, and
/// of the rows, as a program that knows no better would write them.
class CatalogueMutator {
 public:
  explicit CatalogueMutator(std::vector<std::string> catalogues)
      : catalogues_(std::move(catalogues)) {}

  std::string next(Dice& dice) const {
    std::string bytes = dice.one_of(catalogues_);
    const int kind = static_cast<int>(dice.below(10));
    if (kind >= 4) change_rows(bytes, dice);
    if (kind < 5) {
      for (std::size_t times = 1 + dice.below(4); times > 0; --times) change_pages(bytes, dice);
    }
    return bytes;
  }

 private:
  static std::size_t page_size(const std::string& bytes) {
    const auto at = [&](std::size_t k) { return static_cast<unsigned char>(bytes[k]); };
    const std::size_t size = bytes.size() < 100 ? 0 : at(16) * 256u + at(17);
    return size < 512 ? 4096 : size;
  }

  static std::uint64_t some_number(Dice& dice) {
    static constexpr std::uint64_t kOdd[] = {
        0,     1,     2,     4,     255,        256,        512,        1024,       4095,    4096,
        32767, 32768, 65535, 65536, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFFFE, 0xFFFFFF};
    return dice.below(2) ? dice.one_of(kOdd) : dice.below(40);
  }

  // Big-endian, as SQLite writes them.
  static void put(std::string& bytes, std::size_t at, std::size_t length, std::uint64_t number) {
    for (std::size_t k = 0; k < length && at + k < bytes.size(); ++k) {
      bytes[at + k] = static_cast<char>(number >> (8 * (length - 1 - k)));
    }
  }

  // The file's bytes.
  static void change_pages(std::string& bytes, Dice& dice) {
    if (bytes.size() < 100) return;
    const std::size_t size = page_size(bytes), pages = bytes.size() / size;
    const auto start = [&](std::size_t page) { return page * size + (page == 0 ? 100 : 0); };
    const std::size_t page = dice.below(pages), at = dice.below(bytes.size());
    switch (dice.below(12)) {
      case 0:
        bytes[at] = static_cast<char>(dice.words()());
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << dice.below(8)));
        break;
      case 2: {
        // The file's header: 2 bytes of page size, bytes, then 4-byte numbers.
        const std::size_t field = 16 + dice.below(21);
        field < 24 ? put(bytes, field, field == 16 ? 2 : 1, some_number(dice))
                   : put(bytes, 24 + 4 * (field - 24), 4, some_number(dice));
        break;
      }
      case 3:  // a page's header: kind, first free block, cells, content, fragments, right child
        put(bytes, start(page) + dice.below(12), 1 + dice.below(4), some_number(dice));
        break;
      case 4:  // where its cells are
        put(bytes, start(page) + 8 + 2 * dice.below(30), 2,
            dice.below(2) ? dice.below(size) : some_number(dice));
        break;
      case 5: {
        const std::size_t other = dice.below(pages);
        for (std::size_t k = 0; k < size; ++k)
          std::swap(bytes[page * size + k], bytes[other * size + k]);
        break;
      }
      case 6:
        bytes.replace(page * size, size, bytes.substr(dice.below(pages) * size, size));
        break;
      case 7:
        bytes.replace(page * size, size, std::string(size, static_cast<char>(dice.below(3) - 1)));
        break;
      case 8:
        if (dice.below(4) == 0) bytes.resize(dice.below(2) ? at : page * size);
        break;
      case 9:
        put(bytes, at, 1 + dice.below(8), some_number(dice));
        break;
      case 10: {
        const std::size_t length = dice.below(64), from = dice.below(bytes.size() - length);
        bytes.replace(std::min(at, bytes.size() - length), length, bytes.substr(from, length));
        break;
      }
      default:
        change_text(bytes, dice);
    }
  }

  // A word of the schema or of a JSON text becomes another, in as many letters.
  static void change_text(std::string& bytes, Dice& dice) {
    static constexpr const char* kWords[] = {
        "INTEGER",  "TEXT",   "REAL",     "BLOB",       "STRICT",    "CREATE",    "TABLE",
        "VIEW",     "CHECK",  "NOT NULL", "draw",       "unit",      "candidate", "lo",
        "hi",       "SELECT", "FROM",     "WHERE",      "json_each", "sum(",      "count",
        "identity", "rows",   "family",   "miura",      "_deg",      "RAISE",     "WITHOUT ROWID",
        "TRIGGER",  "INDEX",  "accepted", "REFERENCES", "GENERATED", "seed",      "A1"};
    const std::string word = dice.one_of(kWords);
    const std::size_t at = bytes.find(word, dice.below(bytes.size()));
    if (at == std::string::npos) return;
    std::string other = dice.one_of(kWords);
    other.resize(word.size(), ' ');
    if (dice.below(3) == 0) other[dice.below(other.size())] = static_cast<char>(dice.words()());
    bytes.replace(at, word.size(), other);
  }

  // What the rows say, past all checks.
  static void change_rows(std::string& bytes, Dice& dice) {
    const bool typeless = dice.below(3) == 0;  // no types any more, in the next connection
    const auto replace_in_schema = [&](const std::string& what, const std::string& by) {
      MemoryDatabase database(bytes);
      database.run("PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(sql, '" +
                   what + "', '" + by + "') WHERE type = 'table'");
      bytes = database.bytes();
    };
    if (typeless) replace_in_schema(") STRICT", ") /*STRICT*/");
    MemoryDatabase database(bytes);
    database.run(
        "PRAGMA writable_schema = ON; PRAGMA ignore_check_constraints = ON; PRAGMA foreign_keys = "
        "OFF");
    const auto triggers = database.texts("SELECT sql FROM sqlite_schema WHERE type = 'trigger'");
    const bool past_triggers = dice.below(2);
    if (past_triggers) database.run("DROP TRIGGER unit_moves; DROP TRIGGER unit_overlaps");
    for (std::size_t times = 1 + dice.below(3); times > 0; --times) {
      database.run(some_sql(database, dice));
    }
    // As an attacker would: a catalogue that is not laid out as one is refused at the door.
    const bool laid_out = dice.below(8) != 0;
    if (past_triggers && laid_out) {
      for (const std::string& trigger : triggers) database.run(trigger);
    }
    bytes = database.bytes();
    if (typeless && laid_out) replace_in_schema(") /*STRICT*/", ") STRICT");
  }

  static std::string some_value(const std::string& column, Dice& dice) {
    static constexpr const char* kValues[] = {
        "NULL",
        "0",
        "-1",
        "1",
        "x'00'",
        "''",
        "'a'",
        "9223372036854775807",
        "-9223372036854775808",
        "4611686018427387904",
        "1e308",
        "-1e308",
        "9e999",
        "0.5",
        "zeroblob(16)",
        "zeroblob(15)",
        "'{}'",
        "'[]'",
        "'[1,2]'",
        "'{\"A8\":[0.4,0.0]}'",
        "CAST(x'ff41fe' AS TEXT)",
        "char(0, 27, 65)",
        "zeroblob(100000)",
        "hex(zeroblob(50000))",
        "printf('%.*c', 3000, '[')",
        "'{\"A8\":' || replace(hex(zeroblob(60000)), '0', "
        "'[') || replace(hex(zeroblob(60000)), '0', ']') || '}'",
        "'x' || char(10, 27) || '[2J' || char(155, 8238)",
        "'2'",
        "5000",
        "1024"};
    switch (dice.below(6)) {
      case 0:
        return column + " + " + std::to_string(dice.below(5)) + " - 2";
      case 1:
        return column + " + 1 << " + std::to_string(dice.below(63));
      case 2:
        return "replace(" + column + ", " + std::to_string(dice.below(10)) + ", " +
               std::to_string(dice.below(10)) + ")";
      case 3:
        return "substr(" + column + ", " + std::to_string(dice.below(9)) + ")";
      default:
        return dice.one_of(kValues);
    }
  }

  // What no program of ours makes: things that run by themselves, or stand in for a table.
  static std::string foreign_object(const std::string& table, const std::string& column,
                                    Dice& dice) {
    switch (dice.below(9)) {
      case 0:
        return "CREATE TRIGGER spy BEFORE INSERT ON " + table + " BEGIN SELECT RAISE(IGNORE); END";
      case 1:
        return "CREATE TRIGGER spy AFTER UPDATE ON " + table + " BEGIN DELETE FROM unit; END";
      case 2:
        return "CREATE VIEW spy AS SELECT * FROM " + table;
      case 3:
        return "CREATE VIRTUAL TABLE spy USING fts3(" + column + ")";
      case 4:
        return "DROP VIEW candidates; CREATE VIEW candidates AS SELECT *, load_extension('x') " +
               column + " FROM " + table;
      case 5:
        return "ALTER TABLE " + table + " ADD COLUMN spy AS (hex(zeroblob(1000000)))";
      case 6:
        return "CREATE INDEX spy ON " + table + " (abs(" + column + "))";
      case 7:
        return "ALTER TABLE " + table + " RENAME TO spy; CREATE VIEW " + table +
               " AS SELECT * FROM spy";
      default:
        return "DROP VIEW faults; CREATE VIEW faults AS WITH RECURSIVE n(first_fault) AS (SELECT 1 "
               "UNION ALL SELECT first_fault FROM n) SELECT * FROM n";
    }
  }

  static std::string some_sql(MemoryDatabase& database, Dice& dice) {
    static constexpr const char* kTables[] = {
        "campaign",  "run",   "unit",       "screened", "fault_sample", "undecided",
        "candidate", "level", "population", "sheet",    "piece",        "certificate"};
    const std::string table = dice.one_of(kTables);
    const auto columns = database.texts("SELECT name FROM pragma_table_info('" + table + "')");
    const std::string column =
        columns.empty() ? "x" : "\"" + columns[dice.below(columns.size())] + "\"";
    const std::string key = table == "population" || table == "piece" ? "level" : "rowid";
    const std::string some_rows =
        dice.below(3) == 0 ? "" : " WHERE " + key + " % 3 = " + std::to_string(dice.below(3));
    const std::string number = std::to_string(some_number(dice));
    switch (dice.below(11)) {
      case 0:
        return "DELETE FROM " + table + some_rows;
      case 1:
        return "CREATE TEMP TABLE one AS SELECT * FROM " + table + " LIMIT 1; UPDATE one SET " +
               column + " = " + column + " + " + number + "; INSERT OR REPLACE INTO " + table +
               " SELECT * FROM one";
      case 2: {  // a unit that adds up, whatever it claims
        const std::string more = dice.below(2) ? number : std::to_string(1ULL << dice.below(62));
        return "UPDATE unit SET hi = hi + " + more + ", rejected = rejected + " + more +
               " WHERE lo = (SELECT max(lo) FROM unit)";
      }
      case 3:
        return "UPDATE unit SET lo = lo - " + number + ", hi = hi - " + number + some_rows;
      case 4: {
        static constexpr const char* kPragmas[] = {"user_version", "application_id",
                                                   "schema_version"};
        return std::string("PRAGMA ") + dice.one_of(kPragmas) + " = " +
               std::to_string(static_cast<int>(dice.below(9)) - 3);
      }
      case 5: {
        const auto names = database.texts("SELECT name FROM sqlite_schema WHERE sql IS NOT NULL");
        if (names.empty()) return "";
        static constexpr const char* kParts[] = {" NOT NULL", "INTEGER", "draw", "unit",
                                                 "CHECK",     "hi",      "lo",   "ORDER BY lo",
                                                 "REAL",      ",",       "(",    "VIRTUAL"};
        return std::string("UPDATE sqlite_schema SET sql = replace(sql, '") + dice.one_of(kParts) +
               "', '" + dice.one_of(kParts) + "') WHERE name = '" +
               names[dice.below(names.size())] + "'";
      }
      case 6:
        return foreign_object(table, column, dice);
      default:
        return "UPDATE OR REPLACE " + table + " SET " + column + " = " + some_value(column, dice) +
               some_rows;
    }
  }

  const std::vector<std::string> catalogues_;
};

}  // namespace misalign::stress
