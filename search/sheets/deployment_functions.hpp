// SQL functions that deploy a draw's sheet: computed when a query asks for it, and stored nowhere.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

#include "search/sheets/folding_model.hpp"

namespace misalign::search {

/// Adds to a catalogue's connection
///   deploy_time_s(draw), deploy_time_s(draw, from_deg)
///   critical_friction_n_mm_per_mm(draw), critical_friction_n_mm_per_mm(draw, from_deg)
/// of any draw of its campaign, as `misalign deploy` says them with its defaults: null where the
/// sheet does not get to flat, does not fold as far, or its path is lost. The model is made when
/// first asked for. A query that calls one ends with SQLITE_ABORT where this build is without
/// SUNDIALS.
void add_deployment_functions(SQLite::Database& database, const std::string& path);
/// The same by this campaign's model, with its springs; both must outlive the queries.
void add_deployment_functions(SQLite::Database& database, const schema::Campaign& campaign,
                              FoldingModel& model);

}  // namespace misalign::search
