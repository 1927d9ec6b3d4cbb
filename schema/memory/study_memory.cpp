#include "schema/memory/study_memory.hpp"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <filesystem>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/connection.hpp"
#include "schema/catalogue/study_table.hpp"
#include "schema/files/hash.hpp"
#include "schema/files/printable.hpp"

namespace misalign::schema {
namespace {

// The default angle of use is a from_deg of 0; value is null where the study has none.
constexpr const char* kLayout =
    "CREATE TABLE number (function TEXT NOT NULL, version INTEGER NOT NULL, inputs TEXT NOT NULL, "
    "from_deg REAL NOT NULL, draw INTEGER NOT NULL, sheet TEXT NOT NULL, value REAL, "
    "PRIMARY KEY (function, version, inputs, from_deg, draw)) STRICT, WITHOUT ROWID";

// Another file's layout could run statements of its own when it is written.
void check_layout(SQLite::Database& database) {
  SQLite::Statement rows(database, "SELECT sql FROM sqlite_schema");
  if (!rows.executeStep() || rows.getColumn(0).getString() != kLayout || rows.executeStep()) {
    throw SQLite::Exception("its layout is not this program's");
  }
}

bool is_directory_writable(const std::string& path) {
  const std::string directory = std::filesystem::path(path).parent_path().string();
  return ::access(directory.empty() ? "." : directory.c_str(), W_OK) == 0;
}

int version_of_function(const std::string& name) {
  const StudyColumn* const column = study_column(name);
  return column ? column->version : -1;
}

}  // namespace

std::string sheet_key(const Eigen::Matrix2Xd& shifts_mm) {
  return hex(hash_of({reinterpret_cast<const char*>(shifts_mm.data()),
                      static_cast<std::size_t>(shifts_mm.size()) * sizeof(double)}));
}

StudyMemory::StudyMemory(const std::string& catalogue, const Campaign& campaign)
    : path_(catalogue.empty() ? "" : path_beside(catalogue)),
      inputs_(hex(hash_of(campaign_json(campaign).dump()))) {}

// Calls `work` unless there was a fault before; false or nothing if there is one now.
template <class Work>
auto StudyMemory::trying(const Work& work) -> decltype(work()) {
  if (fault_.empty() && !path_.empty()) {
    try {
      return work();
    } catch (const std::exception& error) {
      fault_ =
          fmt::format("{}: is not used ({}), so numbers of sheets are computed again; delete it",
                      printable(path_), error.what());
    }
  }
  return decltype(work())();
}

// Returns whether there is a file to use; where it can be written, an interrupted transaction is
// undone.
bool StudyMemory::is_open(Missing missing) {
  if (database_) return true;
  if (missing == Missing::stays && !std::filesystem::exists(path_)) return false;
  const bool is_writable = is_directory_writable(path_);
  if (missing == Missing::is_made && !is_writable) return false;
  auto database = connect(path_, is_writable ? Access::write : Access::read);
  if (missing == Missing::is_made) {
    SQLite::Transaction making(*database, SQLite::TransactionBehavior::IMMEDIATE);
    if (database->execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0) {
      database->exec(kLayout);
    }
    making.commit();
  }
  check_layout(*database);
  finding_ = std::make_unique<SQLite::Statement>(
      *database,
      "SELECT sheet, value FROM number WHERE function = ? AND version = ? AND inputs = ? "
      "AND from_deg = ? AND draw = ?");
  database_ = std::move(database);
  return true;
}

bool StudyMemory::find(StudyNumber& number) {
  return trying([&] {
    if (!is_open(Missing::stays)) return false;
    bind_all(*finding_, number.function, version_of_function(number.function), inputs_,
             number.from_deg.value_or(0), number.draw);
    const bool is_found =
        finding_->executeStep() && finding_->getColumn(0).getString() == number.sheet;
    if (is_found) {
      const SQLite::Column value = finding_->getColumn(1);
      number.value = value.isNull() ? std::nullopt : std::optional(value.getDouble());
    }
    finding_->reset();  // otherwise nobody could commit
    return is_found;
  });
}

void StudyMemory::keep(const std::vector<StudyNumber>& numbers) {
  trying([&] {
    if (numbers.empty() || !is_open(Missing::is_made) ||
        sqlite3_db_readonly(database_->getHandle(), "main") == 1)
      return;
    SQLite::Transaction together(*database_, SQLite::TransactionBehavior::IMMEDIATE);
    SQLite::Statement row(*database_, "INSERT OR REPLACE INTO number VALUES (?, ?, ?, ?, ?, ?, ?)");
    for (const StudyNumber& number : numbers) {
      bind_all(row, number.function, version_of_function(number.function), inputs_,
               number.from_deg.value_or(0), number.draw, number.sheet, number.value);
      row.exec();
    }
    together.commit();
  });
}

std::vector<std::string> StudyMemory::functions() {
  return trying([&] {
    std::vector<std::string> names;
    if (!is_open(Missing::stays)) return names;
    SQLite::Statement rows(*database_,
                           "SELECT DISTINCT function, version FROM number WHERE inputs = ? AND "
                           "from_deg = 0 ORDER BY function");
    bind_all(rows, inputs_);
    while (rows.executeStep()) {
      const std::string name = rows.getColumn(0).getString();
      if (rows.getColumn(1).getInt() == version_of_function(name)) names.push_back(name);
    }
    return names;
  });
}

std::vector<StudyNumber> StudyMemory::all() {
  return trying([&] {
    std::vector<StudyNumber> numbers;
    if (!is_open(Missing::stays)) return numbers;
    SQLite::Statement rows(*database_,
                           "SELECT function, version, from_deg, draw, sheet, value FROM number "
                           "WHERE inputs = ? ORDER BY function, from_deg, draw");
    bind_all(rows, inputs_);
    while (rows.executeStep()) {
      StudyNumber number{rows.getColumn(0).getString(),
                         rows.getColumn(2).getDouble(),
                         draw_of(rows.getColumn(3)),
                         rows.getColumn(4).getString(),
                         {}};
      if (rows.getColumn(1).getInt() != version_of_function(number.function)) continue;
      if (number.from_deg == 0) number.from_deg.reset();
      if (!rows.getColumn(5).isNull()) number.value = rows.getColumn(5).getDouble();
      numbers.push_back(std::move(number));
    }
    return numbers;
  });
}

std::uint64_t StudyMemory::stale() {
  const std::uint64_t current = all().size();
  return trying([&]() -> std::uint64_t {
    if (!is_open(Missing::stays)) return 0;
    return draw_of(database_->execAndGet("SELECT count(*) FROM number")) - current;
  });
}

}  // namespace misalign::schema
