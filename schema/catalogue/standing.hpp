// Counts a campaign's draws so far and finds its best one, for the progress of a search.
#pragma once

#include <optional>

#include "schema/records/unit_record.hpp"

namespace misalign::schema {

struct Standing {
  struct Best {
    double deploys_from_deg;
    std::uint64_t draw;
  };
  std::uint64_t draws = 0, accepted = 0;  ///< counts of the whole ledger
  std::optional<Best> best{};             ///< first draw with the largest D

  void add(const UnitRecord& unit);
};

/// Reads the standing of a catalogue. UserError (bad_input) if it is damaged.
Standing read_standing(SQLite::Database& database);

}  // namespace misalign::schema
