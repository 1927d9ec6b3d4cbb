// The Pareto front of several numbers of candidates: those that no other candidate dominates.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>
#include <vector>

namespace misalign::search {

/// The SELECT of draw and these columns or functions for the front of the candidates that satisfy
/// `where` (which may be empty) and have all values; ordered by the first word, the best first.
/// UserError (bad_request, "front", "where").
std::string front_sql(SQLite::Database& database, const std::vector<std::string>& words,
                      const std::string& where);

}  // namespace misalign::search
