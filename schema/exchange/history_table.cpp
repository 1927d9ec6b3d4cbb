#include "schema/exchange/history_table.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <iterator>

#include "schema/files/text_table.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::schema {
namespace {

using Eigen::Index;

// Appends a cell, which is empty where there is no finite number.
void append(std::string& text, int digits, double value) {
  text += ",";
  if (std::isfinite(value)) fmt::format_to(std::back_inserter(text), "{:.{}g}", value, digits);
}

// Lengths and angles have the digits of the solver, derived quantities fewer.
void append_measured(std::string& text, double value) { append(text, 12, value); }
void append_derived(std::string& text, double value) { append(text, 9, value); }

std::string ends(int from, int to) {
  return fmt::format(",{},{}", solver::vertex_label(from), solver::vertex_label(to));
}

// Lengths of the diagonals at a row of an actuation, flat first.
Eigen::VectorXd lengths_at_mm(const solver::FoldingHistory& history, Index row) {
  if (row > 0) return history.length_mm.row(row - 1);
  return Eigen::VectorXd::Map(history.flat_mm.data(), std::ssize(history.flat_mm));
}

// Energy of a diagonal's spring, or half of its hole's plate.
double energy_n_mm(const solver::Filling& filling, const Eigen::VectorXd& lengths_mm,
                   Index diagonal) {
  const Index first = diagonal - diagonal % 2;
  const solver::HoleEnergy hole = filling.hole(diagonal / 2, lengths_mm.segment<2>(first));
  if (!filling.is_springs()) return hole.n_mm / 2;
  return hole.force_n(diagonal - first) * (lengths_mm(diagonal) - filling.relaxed_mm()(diagonal)) /
         2;
}

bool is_shown(double pilot_deg, const FoldingView& view, double every_deg) {
  assert(every_deg >= 0);
  constexpr double kSame_deg = 1e-9;
  if (every_deg == 0) return true;
  const double reached_deg = view.history.verdict.deploys_from_sample * view.sample_deg;
  return std::abs(std::remainder(pilot_deg, every_deg)) < kSame_deg ||
         std::abs(pilot_deg - reached_deg) < kSame_deg;
}

}  // namespace

std::string diagonal_columns(const RowKey& key) {
  return key.name +
         ",pilot_deg,diagonal,hole_row,hole_column,from_vertex,to_vertex,length_mm,elongation,"
         "force_n,energy_n_mm,moment_n_mm,mechanical_advantage\n";
}

std::string diagonal_rows(const RowKey& key, const FoldingView& view,
                          const solver::Actuation& actuation, double every_deg) {
  const std::string sheet = csv_cell(key.value) + ",";
  std::vector<std::string> names;  // constant cells of each diagonal
  assert(std::ssize(actuation.pilot_deg) == actuation.force_n.rows());
  for (std::size_t d = 0; d < view.mechanism.diagonals.size(); ++d) {
    const solver::Diagonal& diagonal = view.mechanism.diagonals[d];
    const auto& hole = view.base.base.sheet.places[view.mechanism.loops[diagonal.loop].hole];
    names.push_back(
        fmt::format(",{},{},{}{}", d, hole[0], hole[1], ends(diagonal.from, diagonal.to)));
  }
  std::string text;
  const solver::Filling filling = solver::filling_of(view.sheet, actuation.actuators.fill);
  for (std::size_t row = 0; row < actuation.pilot_deg.size(); ++row) {
    if (!is_shown(actuation.pilot_deg[row], view, every_deg)) continue;
    const auto at = static_cast<Index>(row);
    const std::string station = sheet + shown_number(actuation.pilot_deg[row]);
    const Eigen::VectorXd lengths_mm = lengths_at_mm(view.history, at);
    for (std::size_t d = 0; d < names.size(); ++d) {
      const auto diagonal = static_cast<Index>(d);
      const double flat_mm = view.history.flat_mm[d];
      const double length_mm = lengths_mm(diagonal);
      const double force_n = actuation.force_n(at, diagonal);
      text += station + names[d];
      append_measured(text, length_mm);
      append_derived(text, (length_mm - flat_mm) / flat_mm);
      append_derived(text, force_n);
      append_derived(text, energy_n_mm(filling, lengths_mm, diagonal));
      append_derived(text, actuation.moment_by_n_mm(at, diagonal));
      append_derived(text, actuation.mechanical_advantage[row]);
      text += "\n";
    }
  }
  return text;
}

std::string crease_columns(const RowKey& key) {
  return key.name + ",pilot_deg,crease,from_vertex,to_vertex,assignment,fold_angle_deg\n";
}

std::string crease_rows(const RowKey& key, const FoldingView& view, double every_deg) {
  const std::string sheet = csv_cell(key.value) + ",";
  std::vector<std::string> names;
  for (std::size_t i = 0; i < view.mechanism.creases.size(); ++i) {
    const solver::Crease& crease = view.mechanism.creases[i];
    names.push_back("," + std::to_string(i) + ends(crease.a, crease.b) +
                    (view.mechanism.is_valley(crease) ? ",valley" : ",mountain"));
  }
  std::string text;
  const auto add_station = [&](double pilot_deg, Index row) {
    if (!is_shown(pilot_deg, view, every_deg)) return;
    const std::string station = sheet + shown_number(pilot_deg);
    for (std::size_t i = 0; i < names.size(); ++i) {
      text += station + names[i];
      const auto crease = static_cast<Index>(i);
      append_measured(text, row < 0 ? 0.0 : view.history.fold_angle_deg(row, crease));
      text += "\n";
    }
  };
  add_station(0, -1);
  for (std::size_t row = 0; row < view.history.stations.size(); ++row) {
    add_station(view.history.stations[row].pilot_deg, static_cast<Index>(row));
  }
  return text;
}

}  // namespace misalign::schema
