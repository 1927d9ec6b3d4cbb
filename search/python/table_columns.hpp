// The rows of a query as columns.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <pybind11/pybind11.h>

#include <string>

namespace misalign::search::python {

/// {name: column}: an array of int64 where all are whole numbers, of float64 where all are numbers
/// or NULL (NaN), else a list of what there is. UserError as from read_query.
pybind11::dict table_of_query(SQLite::Database& database, const std::string& sql);

}  // namespace misalign::search::python
