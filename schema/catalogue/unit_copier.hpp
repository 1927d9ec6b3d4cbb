// Copies units from one catalogue into another, row by row and unchanged.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <memory>
#include <string>

#include "schema/campaign/draw_range.hpp"
#include "schema/campaign/search_method.hpp"

namespace misalign::schema {

/// Works within a transaction on `into` of its caller. `from` may have an older schema, whose
/// missing columns stay null. Throws SQLite::Exception about `into`; UserError (3) if `from` is
/// damaged.
class UnitCopier {
 public:
  /// Prepares the copying for a campaign with this search method.
  UnitCopier(SQLite::Database& from, SQLite::Database& into, const SearchMethod& method);
  ~UnitCopier();
  UnitCopier(const UnitCopier&) = delete;
  UnitCopier& operator=(const UnitCopier&) = delete;

  /// Copies all runs, under new numbers, and the advisory screened counts.
  void copy_runs();
  /// Copies one unit of `from` with all its rows. After copy_runs.
  void copy(const DrawRange& unit);

 private:
  class Table;
  std::unique_ptr<Table> table(const std::string& name, const std::string& condition);

  SQLite::Database& from_;
  SQLite::Database& into_;
  const std::uint64_t run_shift_;
  std::unique_ptr<Table> unit_, candidate_, undecided_, fault_sample_;
  std::unique_ptr<Table> population_, sheet_, ascent_;  // null where the method has none
};

}  // namespace misalign::schema
