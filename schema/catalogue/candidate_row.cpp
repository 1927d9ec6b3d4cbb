#include "schema/catalogue/candidate_row.hpp"

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/result_table.hpp"
#include "schema/files/json_values.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "schema/pattern/vertex_labels.hpp"

namespace misalign::schema {

Json diagonal_json(const Pattern& base, const solver::Mechanism& mechanism,
                   const solver::Diagonal& diagonal, double flat_mm) {
  return {{"hole", facet_json(base, mechanism.loops[diagonal.loop].hole)},
          {"from", solver::vertex_label(diagonal.from)},
          {"to", solver::vertex_label(diagonal.to)},
          {"flat_mm", flat_mm}};
}

Json diagonals_json(const Campaign& campaign, const solver::Mechanism& mechanism) {
  const auto& vertices = campaign.pattern.base.sheet.vertices_mm;
  return json_list(mechanism.diagonals, [&](const solver::Diagonal& diagonal) {
    const double flat_mm = (vertices.col(diagonal.from) - vertices.col(diagonal.to)).norm();
    return diagonal_json(campaign.pattern, mechanism, diagonal, flat_mm);
  });
}

std::string where_label(const solver::Mechanism& mechanism, const solver::Verdict& verdict) {
  if (verdict.where < 0) return "";
  switch (solver::entry_of(verdict.first_fault).shown_by) {
    case solver::FaultEntry::ShownBy::nothing:
      return "";
    case solver::FaultEntry::ShownBy::crease:
      return solver::line_label(mechanism.creases[verdict.where].a,
                                mechanism.creases[verdict.where].b);
    case solver::FaultEntry::ShownBy::diagonal:
      return solver::line_label(mechanism.diagonals[verdict.where].from,
                                mechanism.diagonals[verdict.where].to);
  }
  return "";
}

const char* undecided_cause(const solver::Verdict& verdict) {
  return verdict.path_end == solver::PathEnd::start_lost ? "start_lost" : "stalled";
}

Json metrics_json(const solver::Metrics& metrics) {
  Json json;
  each_metric(metrics, [&](const MetricEntry& entry, const auto& value) {
    if constexpr (requires { value.has_value(); }) {
      json[entry.name] = or_null(value);
    } else {
      json[entry.name] = value;
    }
  });
  return json;
}

std::optional<Eigen::Matrix2Xd> read_shifts(const Json& displacements_mm, int vertices) {
  const Json json = json_of(displacements_mm);
  if (!json.is_object()) return {};
  Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, vertices);
  for (const auto& [label, shift] : json.items()) {
    const int vertex = vertex_of_label(label, vertices);
    if (vertex < 0 || !are_numbers(shift, 2)) return {};
    shifts_mm.col(vertex) << shift[0].get<double>(), shift[1].get<double>();
  }
  return shifts_mm;
}

Json read_candidate(SQLite::Database& database, std::uint64_t draw) {
  return row_of_draw(database, "candidate", draw);
}

int metrics_version_of(SQLite::Database& database, std::uint64_t draw) {
  return reading(database, [&] {
    SQLite::Statement row =
        bound(database,
              "SELECT metrics_version FROM candidate JOIN unit ON unit.lo = candidate.unit "
              "JOIN run ON run.id = unit.run WHERE draw = ?",
              draw);
    return row.executeStep() ? row.getColumn(0).getInt() : solver::kMetricsVersion;
  });
}

}  // namespace misalign::schema
