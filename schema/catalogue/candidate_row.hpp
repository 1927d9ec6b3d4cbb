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

/// Those of a campaign's base pattern, as its catalogue keeps them: a list of diagonal_json.
Json diagonals_json(const Campaign& campaign, const solver::Mechanism& mechanism);

/// "A17-A23" of a diagonal or crease that a verdict names; empty if it names none.
std::string where_label(const solver::Mechanism& mechanism, const solver::Verdict& verdict);

/// "start_lost" or "stalled".
const char* undecided_cause(const solver::Verdict& verdict);

/// The metrics under the names of their columns.
Json metrics_json(const solver::Metrics& metrics);

/// The displacements of a candidate's row, one column per vertex; nothing if they are none of a
/// sheet with so many.
std::optional<Eigen::Matrix2Xd> read_shifts(const Json& displacements_mm, int vertices);

/// A candidate's row, every column under its name; null if there is none.
Json read_candidate(SQLite::Database& database, std::uint64_t draw);

/// The version of the metrics (see solver::kMetricsVersion) that a candidate was measured by.
int metrics_version_of(SQLite::Database& database, std::uint64_t draw);

}  // namespace misalign::schema
