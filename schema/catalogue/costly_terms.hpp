// Makes SQLite evaluate costly functions last: on rows for which everything else holds.
#pragma once

#include <string>

namespace misalign::schema {

/// Returns the query with each call of a study's function (study_table.hpp) in a WHERE or ON as a
/// scalar subquery. SQLite evaluates such terms last, in any order of the terms that AND joins.
std::string costly_in_subqueries(const std::string& query);

/// Returns whether the SQL calls a function of the table of studies.
bool calls_costly(const std::string& sql);
/// Returns whether a LIMIT may end the query early.
bool has_limit(const std::string& sql);

/// Expands short names to SQL: D is deploys_from_deg, and a function's name alone is that of the
/// draw, "thickness_mm" thickness_mm(draw). Not after a dot, or AS.
std::string in_full(const std::string& sql);

/// Returns the condition expanded likewise, with its costly terms behind all others; these may be
/// subqueries.
std::string costly_last(const std::string& condition);

}  // namespace misalign::schema
