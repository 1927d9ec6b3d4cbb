// Checks all certificates of a catalogue, and copies them into another one.
#pragma once

#include "schema/catalogue/certificate_row.hpp"
#include "schema/catalogue/finding.hpp"

namespace misalign::schema {

/// Number of checked certificates, and findings.
struct CheckedCertificates {
  std::uint64_t count = 0;
  std::vector<Finding> findings;
};

/// Checks that every certificate belongs to a candidate, keeps its hash, and has the columns of its
/// proof (see certificate_fault). UserError (bad_input) if the file cannot be read.
CheckedCertificates check_certificates(SQLite::Database& database, const Campaign& campaign);

/// Copies certificates of another catalogue of this campaign, within the caller's transaction, for
/// candidates that are in this one, of a splitting search under any number. Of two certificates of
/// one candidate, one that also proves that no panels meet is preferred, then the larger certified
/// angle, then the stored one. One with a certificate_fault is never copied, and is replaced by one
/// without. Returns how many were refused for that. UserError (bad_input) if `from` cannot be read.
std::uint64_t copy_certificates(SQLite::Database& from, SQLite::Database& into,
                                const Campaign& campaign, const solver::Mechanism& mechanism);

/// Copies a certificate within one catalogue, from one candidate to another of the same sheet.
void hand_on_certificate(SQLite::Database& database, const Campaign& campaign,
                         const solver::Mechanism& mechanism, std::uint64_t from, std::uint64_t to);

}  // namespace misalign::schema
