// Checks a catalogue's ledger against the rest of its rows, without following any path: rows that
// were added, deleted or altered show in the ledger's sums.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// The file's integrity, foreign keys and CHECKs; the campaign's identity, diagonals and goal's
/// end, and what its runs say of themselves (see campaign_check.hpp); for every unit the number of
/// its candidates, its part of the digest, its undecided draws, none of which is a candidate, and
/// its fault sample, which accepts what the candidates do; and the digest of the whole against the
/// candidates alone. Of one moment, if the caller holds a transaction. UserError (bad_input) if the
/// file cannot be read so far.
std::vector<Finding> check_ledger(SQLite::Database& database, const Campaign& campaign);

/// What read_state says, which the check needs anyway, or why it says nothing; and the findings.
struct CheckedLedger {
  std::vector<Finding> findings;
  std::optional<CatalogueState> state;
  std::string why_no_state;
};
CheckedLedger read_checked(SQLite::Database& database, const Campaign& campaign);

}  // namespace misalign::schema
