// A catalogue's rows about a sheet: its diagonals, where it fails, its metrics.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>

#include "schema/campaign/campaign.hpp"
#include "schema/catalogue/metric_table.hpp"

namespace misalign::schema {

/// {"hole": [row, column], "from", "to", "flat_mm"}
Json diagonal_json(const Pattern& base, const solver::Mechanism& mechanism,
                   const solver::Diagonal& diagonal, double flat_mm);

/// Returns the diagonals of a campaign's base pattern as its catalogue stores them: a list of
/// diagonal_json.
Json diagonals_json(const Campaign& campaign, const solver::Mechanism& mechanism);

/// Returns the label of the diagonal or crease that a verdict names, "A17-A23"; empty if it names
/// none.
std::string where_label(const solver::Mechanism& mechanism, const solver::Verdict& verdict);

/// "start_lost" or "stalled".
const char* undecided_cause(const solver::Verdict& verdict);

/// Returns the metrics by the names of their columns.
Json metrics_json(const solver::Metrics& metrics);

/// Returns the displacements of a candidate's row, one column per vertex; none if they do not fit a
/// sheet with this number of vertices.
std::optional<Eigen::Matrix2Xd> read_shifts(const Json& displacements_mm, int vertices);

/// Returns a candidate's row by the names of its columns; null without a row.
Json read_candidate(SQLite::Database& database, std::uint64_t draw);

/// Returns the version of the metrics (see solver::kMetricsVersion) of a candidate.
int metrics_version_of(SQLite::Database& database, std::uint64_t draw);

}  // namespace misalign::schema
