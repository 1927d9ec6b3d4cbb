// The shifts of a sheet that a catalogue's number names.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "schema/campaign/campaign.hpp"

namespace misalign::search {

/// A plain campaign makes any draw again. A splitting one has those of its candidates stored: to
/// make them again takes a whole population. An optimising one has candidates stored, and makes
/// other draws again. UserError: 2 it is none of its candidates, 3 the row is damaged.
Eigen::Matrix2Xd shifts_of_number(SQLite::Database& database, const schema::Campaign& campaign,
                                  std::uint64_t number);

}  // namespace misalign::search
