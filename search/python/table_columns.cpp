#include "search/python/table_columns.hpp"

#include <sqlite3.h>

#include <cmath>
#include <variant>
#include <vector>

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/result_table.hpp"
#include "search/python/arrays.hpp"
#include "search/python/signals.hpp"
#include "search/sheets/study_functions.hpp"

namespace misalign::search::python {
namespace {

namespace py = pybind11;

constexpr int kStepsBetweenSignals =
    1000000;  // steps of SQLite's machine: some hundredths of a second

// Checks signals for SQLite, which then ends the statement; the exception is set.
int is_interrupted(void*) {
  const py::gil_scoped_acquire lock;
  return PyErr_CheckSignals();
}

struct Bytes {
  std::string bytes;
};
using Cell = std::variant<std::monostate, std::int64_t, double, std::string, Bytes>;

Cell cell_of(const SQLite::Column& column) {
  if (column.isNull()) return {};
  if (column.isInteger()) return column.getInt64();
  if (column.isFloat()) return column.getDouble();
  if (column.isBlob()) return Bytes{column.getString()};
  return schema::text_of(column);
}

// Stores numbers contiguously while a column has no others; the places of NULL are kept.
class Column {
 public:
  void add(Cell cell) {
    all_whole_ &= std::holds_alternative<std::int64_t>(cell);
    all_numbers_ &= cell.index() <= 2;
    any_number_ |= cell.index() == 1 || cell.index() == 2;
    cells_.push_back(std::move(cell));
  }

  py::object array() const {
    if (!cells_.empty() && all_whole_) return filled<std::int64_t>();
    if (!cells_.empty() && all_numbers_ && any_number_) return filled<double>();
    py::list list;
    for (const Cell& cell : cells_) list.append(std::visit(AsObject(), cell));
    return list;
  }

 private:
  struct AsObject {
    py::object operator()(std::monostate) const { return py::none(); }
    py::object operator()(std::int64_t value) const { return py::int_(value); }
    py::object operator()(double value) const { return py::float_(value); }
    py::object operator()(const std::string& text) const { return py::str(text); }
    py::object operator()(const Bytes& blob) const { return py::bytes(blob.bytes); }
  };

  template <class Value>
  py::array_t<Value> filled() const {
    py::array_t<Value> values(static_cast<py::ssize_t>(cells_.size()));
    Value* to = values.mutable_data();
    for (const Cell& cell : cells_) {
      if (const auto* whole = std::get_if<std::int64_t>(&cell)) {
        *to++ = static_cast<Value>(*whole);
      } else {
        const auto* number = std::get_if<double>(&cell);
        *to++ = number ? static_cast<Value>(*number) : static_cast<Value>(std::nan(""));
      }
    }
    return values;
  }

  std::vector<Cell> cells_;
  bool all_whole_ = true, all_numbers_ = true, any_number_ = false;
};

}  // namespace

py::dict table_of_query(SQLite::Database& database, const std::string& sql) {
  std::vector<std::string> names;
  std::vector<Column> columns;
  sqlite3_progress_handler(database.getHandle(), kStepsBetweenSignals, is_interrupted, nullptr);
  try {
    unlocked([&] {
      names = schema::query_columns(database, sql);
      columns.resize(names.size());
      look_ahead(database, sql);
      schema::read_query(database, sql, [&](const SQLite::Statement& row) {
        for (std::size_t k = 0; k < columns.size(); ++k) {
          columns[k].add(cell_of(row.getColumn(static_cast<int>(k))));
        }
      });
    });
  } catch (const schema::UserError&) {
    if (PyErr_Occurred()) throw py::error_already_set();
    throw;
  }
  py::dict table;
  for (std::size_t k = 0; k < names.size(); ++k) table[py::str(names[k])] = columns[k].array();
  return table;
}

}  // namespace misalign::search::python
