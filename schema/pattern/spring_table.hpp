// Reads and lists springs that can be bought.
#pragma once

#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "solver/fitting/stock_spring.hpp"

namespace misalign::schema {

/// A type of springs in a table.
struct SpringRow {
  std::string name;
  solver::StockSpring spring;
};

/// Returns common sizes of springs of music wire, from the formulas of helical springs. Prices are
/// invented: they grow with the amount of wire. A shop's own table replaces these rows.
std::vector<SpringRow> common_springs();

/// Reads a table in CSV whose first line names its columns: name, rate_n_per_mm, free_mm,
/// longest_mm, wire_mm, outer_mm, price; also kind ("pulls" or "pushes"), initial_n and
/// shortest_mm. UserError (bad_input) with every fault, each with its line.
std::vector<SpringRow> read_spring_table(const std::string& path);
/// The same of a text from `source`.
std::vector<SpringRow> spring_table_of(const std::string& text, const std::string& source);

/// A row as an object: the columns' names, null for those that are not of its kind.
Json spring_row_json(const SpringRow& row);

/// Returns the springs of a table without their names.
std::vector<solver::StockSpring> springs_of(const std::vector<SpringRow>& table);

/// "pulls".
const char* word_of(solver::SpringAction action);

}  // namespace misalign::schema
