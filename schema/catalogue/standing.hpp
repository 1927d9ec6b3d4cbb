// The counts and the best draw of a campaign so far, for the progress of a search.
#pragma once

#include <optional>

#include "schema/records/unit_record.hpp"

namespace misalign::schema {

struct Standing {
  struct Best {
    double deploys_from_deg;
    std::uint64_t draw;
  };
  std::uint64_t draws = 0, accepted = 0;  ///< in the whole ledger
  std::optional<Best> best{};             ///< the first of those that deploy from the deepest fold

  void add(const UnitRecord& unit);
};

/// Of a catalogue. UserError (bad_input) if it is damaged.
Standing read_standing(SQLite::Database& database);

}  // namespace misalign::schema
