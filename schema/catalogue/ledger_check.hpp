// Checks a catalogue's ledger against its other rows, without following a path: added, deleted or
// altered rows change the ledger's sums.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// Checks the file's integrity, foreign keys and CHECKs; the campaign's identity, diagonals, goal's
/// end and runs (see campaign_check.hpp); of every unit the number of candidates, the part of the
/// digest, undecided draws, none of which is a candidate, and the fault sample, which accepts
/// exactly the candidates; and the digest of the whole against the candidates. Consistent if the
/// caller holds a transaction. UserError (bad_input) if the file cannot be read so far.
std::vector<Finding> check_ledger(SQLite::Database& database, const Campaign& campaign);

/// Result of read_state, which the check needs anyway, or its error; and the findings.
struct CheckedLedger {
  std::vector<Finding> findings;
  std::optional<CatalogueState> state;
  std::string why_no_state;
};
CheckedLedger read_checked(SQLite::Database& database, const Campaign& campaign);

}  // namespace misalign::schema
