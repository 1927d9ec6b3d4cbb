// A catalogue's certificates, all of them: against their candidates, and into another catalogue.
#pragma once

#include "schema/catalogue/certificate_row.hpp"
#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// How many certificates were looked at, and what is wrong with them.
struct CheckedCertificates {
  std::uint64_t count = 0;
  std::vector<Finding> findings;
};

/// Every certificate is a candidate's, keeps its hash, and its columns say what its proof says (see
/// certificate_fault). UserError (bad_input) if the file cannot be read.
CheckedCertificates check_certificates(SQLite::Database& database, const Campaign& campaign);

/// Takes over those of another catalogue of this campaign whose candidates are in this one, of a
/// splitting search under whatever number, within its caller's transaction. Of two of one candidate
/// that stays which also proves that no panels meet; of two that both do, or both do not, that
/// which goes farther; of equals the one that is there. None with a certificate_fault is taken, and
/// none stays if the other has one without; how many were not taken for that. UserError (bad_input)
/// if `from` cannot be read.
std::uint64_t copy_certificates(SQLite::Database& from, SQLite::Database& into,
                                const Campaign& campaign, const solver::Mechanism& mechanism);

/// The same within one catalogue: from one candidate to another that is the same sheet.
void hand_on_certificate(SQLite::Database& database, const Campaign& campaign,
                         const solver::Mechanism& mechanism, std::uint64_t from, std::uint64_t to);

}  // namespace misalign::schema
