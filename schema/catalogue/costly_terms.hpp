// Makes SQLite evaluate costly functions last: on rows for which everything else holds.
#pragma once

#include <string>

namespace misalign::schema {

/// The same query, each call of a study's function (study_table.hpp) in a WHERE or ON a scalar
/// subquery: SQLite computes terms that have one last, whatever the order in which AND joins them.
std::string costly_in_subqueries(const std::string& query);

/// Whether it calls a function of the table of studies.
bool calls_costly(const std::string& sql);
/// Whether a LIMIT may end it early.
bool has_limit(const std::string& sql);

/// Words of people as SQL: D is deploys_from_deg, and a function's name alone is that of the draw,
/// "thickness_mm" thickness_mm(draw). Not behind a dot, or AS.
std::string in_full(const std::string& sql);

/// The same condition, likewise, and its terms with a costly function behind all others, which may
/// be subqueries themselves.
std::string costly_last(const std::string& condition);

}  // namespace misalign::schema
