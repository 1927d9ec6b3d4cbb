// Writes histories as long tables (CSV): one row for each sheet, angle and diagonal, or crease. Any
// number of sheets make one table, which pandas, R, MATLAB and spreadsheets group, filter and plot.
#pragma once

#include <string>

#include "schema/exchange/folding_json.hpp"
#include "solver/motion/actuation.hpp"

namespace misalign::schema {

/// The first column's name and value, which name a sheet: {"draw", "7"} or {"pattern", "table1"}.
struct RowKey {
  std::string name, value;
};

/// Line of the columns' names: KEY, pilot_deg, diagonal (numbered as in the view `diagonals`, from
/// 0), hole_row, hole_column, from_vertex, to_vertex, length_mm, elongation (a share: 0.02 = 2 %),
/// force_n, energy_n_mm, moment_n_mm, mechanical_advantage.
std::string diagonal_columns(const RowKey& key);
/// The lines of one sheet, flat first, at every sample, or at multiples of `every_deg` and at D if
/// it is not 0. Force, energy and moment are those of the diagonal's spring: those of a station add
/// up to the sheet's. The mechanical advantage is the sheet's, in all rows of a station, empty when
/// flat.
std::string diagonal_rows(const RowKey& key, const FoldingView& view,
                          const solver::Actuation& actuation, double every_deg = 0);

/// Line of the columns' names: KEY, pilot_deg, crease (numbered from 0 as in `fold --json`),
/// from_vertex, to_vertex, assignment, fold_angle_deg (valley positive).
std::string crease_columns(const RowKey& key);
/// The lines of one sheet, at the same angles.
std::string crease_rows(const RowKey& key, const FoldingView& view, double every_deg = 0);

}  // namespace misalign::schema
