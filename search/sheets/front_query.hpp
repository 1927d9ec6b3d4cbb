// The front of several numbers of candidates: those than which no other is at least as good in all
// of them and better in one.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>
#include <vector>

namespace misalign::search {

/// The SELECT of it: draw and these columns or functions of candidates, of those that `where`
/// (which may be empty) lets through and that have all of them, by the first, the best first.
/// UserError (bad_request, "front", "where").
std::string front_sql(SQLite::Database& database, const std::vector<std::string>& words,
                      const std::string& where);

}  // namespace misalign::search
