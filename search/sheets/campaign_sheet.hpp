// The shifts of a sheet that a catalogue's number names.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "schema/campaign/campaign.hpp"

namespace misalign::search {

/// Of a plain campaign any draw's, made again; of a splitting one a candidate's, as stored: to make
/// that again takes its whole population; of an optimising one a candidate's, as stored, or of any
/// other draw its own. UserError: 2 it is none of its candidates, 3 the row is damaged.
Eigen::Matrix2Xd shifts_of_number(SQLite::Database& database, const schema::Campaign& campaign,
                                  std::uint64_t number);

}  // namespace misalign::search
