#include "schema/catalogue/unit_copier.hpp"

#include <algorithm>
#include <vector>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/unit_writer.hpp"

namespace misalign::schema {
namespace {

// Reads the columns of the file's own table: over an older one a reader has present-day views.
std::vector<std::string> columns_of(SQLite::Database& database, const std::string& table) {
  return reading(database, [&] {
    std::vector<std::string> names;
    SQLite::Statement rows(database, "PRAGMA main.table_info(" + table + ")");
    while (rows.executeStep()) names.push_back(rows.getColumn("name").getString());
    return names;
  });
}

std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

}  // namespace

// Copies rows of a table: all columns of the target, with run numbers in those named `shifted`
// renumbered.
class UnitCopier::Table {
 public:
  Table(SQLite::Database& from, SQLite::Database& into, const std::string& name,
        const std::string& condition, const std::string& shifted, std::uint64_t shift)
      : from_(from),
        columns_(columns_of(into, name)),
        shifted_(std::find(columns_.begin(), columns_.end(), shifted) - columns_.begin()),
        shift_(shift),
        select_(prepared(from, select_of(from, name) + condition)),
        insert_(into, insert_of(name)) {}

  void copy(const DrawRange& range) {
    bind_all(select_, range.lo, range.hi);
    copy_rows(from_, select_, insert_, [&] {
      for (int k = 0; k < static_cast<int>(columns_.size()); ++k) {
        if (k == shifted_) {
          bind_value(insert_, k + 1, draw_of(select_.getColumn(k)) + shift_);
        } else {
          bind_value(insert_, k + 1, select_.getColumn(k));
        }
      }
    });
  }

 private:
  std::string select_of(SQLite::Database& from, const std::string& name) const {
    const std::vector<std::string> theirs = columns_of(from, name);
    std::vector<std::string> expressions;
    for (const std::string& column : columns_) {  // null if an older schema lacks it
      const bool is_there = std::find(theirs.begin(), theirs.end(), column) != theirs.end();
      expressions.push_back(is_there ? "\"" + column + "\"" : "NULL");
    }
    return "SELECT " + listed(expressions) + " FROM main." + name + " ";
  }
  std::string insert_of(const std::string& name) const {
    std::vector<std::string> quoted;
    for (const std::string& column : columns_) quoted.push_back("\"" + column + "\"");
    return "INSERT INTO " + name + " (" + listed(quoted) + ") VALUES (" +
           listed(std::vector<std::string>(columns_.size(), "?")) + ")";
  }

  SQLite::Database& from_;
  const std::vector<std::string> columns_;
  const std::ptrdiff_t shifted_;
  const std::uint64_t shift_;
  SQLite::Statement select_, insert_;
};

UnitCopier::UnitCopier(SQLite::Database& from, SQLite::Database& into, const SearchMethod& method)
    : from_(from),
      into_(into),
      run_shift_(draw_of(into.execAndGet("SELECT coalesce(max(id), 0) FROM run"))),
      unit_(table("unit", "WHERE lo = ? AND hi = ?")),
      candidate_(table("candidate", "WHERE draw >= ? AND draw < ? ORDER BY draw")),
      undecided_(table("undecided", "WHERE draw >= ? AND draw < ? ORDER BY draw")),
      fault_sample_(table("fault_sample", "WHERE draw >= ? AND draw < ? ORDER BY draw")) {
  if (!method.stores_sheets()) return;
  if (method.splitting)
    population_ = table("population", "WHERE unit >= ? AND unit < ? ORDER BY unit, level");
  if (method.has_ends()) ascent_ = table("ascent", "WHERE draw >= ? AND draw < ? ORDER BY draw");
  sheet_ = table("sheet", "WHERE draw >= ? AND draw < ? ORDER BY draw");
}

UnitCopier::~UnitCopier() = default;

std::unique_ptr<UnitCopier::Table> UnitCopier::table(const std::string& name,
                                                     const std::string& condition) {
  return std::make_unique<Table>(from_, into_, name, condition, name == "run" ? "id" : "run",
                                 run_shift_);
}

void UnitCopier::copy_runs() {
  table("run", "WHERE id >= ? AND id < ? ORDER BY id")->copy({0, kEndOfDraws});
  SQLite::Statement add(into_, kAddScreened);
  SQLite::Statement rows = prepared(from_, "SELECT cause, tested_deg, draws FROM screened");
  copy_rows(from_, rows, add, [&] {
    for (int k = 0; k < 3; ++k) bind_value(add, k + 1, rows.getColumn(k));
  });
}

void UnitCopier::copy(const DrawRange& unit) {
  for (const auto& rows :
       {&unit_, &candidate_, &undecided_, &fault_sample_, &population_, &sheet_, &ascent_}) {
    if (*rows) (*rows)->copy(unit);
  }
}

}  // namespace misalign::schema
