// Returns the rows of a query as columns.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <pybind11/pybind11.h>

#include <string>

namespace misalign::search::python {

/// Returns {name: column}: an array of int64 if all values are whole numbers, of float64 if all are
/// numbers or NULL (NaN), else a list. UserError as from read_query.
pybind11::dict table_of_query(SQLite::Database& database, const std::string& sql);

}  // namespace misalign::search::python
