// SQL functions of the studies' numbers: computed for a draw's sheet when a query calls them, on
// all cores, and remembered beside the catalogue.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

#include "search/sheets/folding_model.hpp"

namespace misalign::search {

enum class Unknown { is_computed, is_null };  ///< a number that is not remembered

/// Adds to a catalogue's connection NAME(draw) and NAME(draw, from_deg) for each column of the
/// table of studies (schema/catalogue/study_table.cpp), for any draw of its campaign with the
/// campaign's design: the value of the study's verb, null where there is none. Models are made on
/// first use; results are kept in the StudyMemory of `path`, and as long as the
/// connection. A query that calls one of a motion ends with SQLITE_ABORT where this build is
/// without SUNDIALS.
void add_study_functions(SQLite::Database& database, const std::string& path);
/// The same by this campaign, with its design; it must outlive the queries. Nothing is remembered
/// where the path is empty.
void add_study_functions(SQLite::Database& database, const schema::Campaign& campaign,
                         const std::string& path, Unknown unknown = Unknown::is_computed);

/// Runs a statement with functions that find nothing, to record their calls in order: from then on
/// the connection finds several at once. Does nothing where the statement calls no such function,
/// or the connection has none.
void look_ahead(SQLite::Database& database, const std::string& sql);

}  // namespace misalign::search
