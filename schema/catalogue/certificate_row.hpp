// Stores certificates of `misalign certify` in a catalogue or a pattern's file.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>
#include <string>
#include <vector>

#include "schema/campaign/campaign.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "schema/records/certificate_record.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::schema {

/// Returns XXH3-128 (32 hex digits) of these bytes, all numbers little-endian: u64 draw; u32
/// vertices, then f64 x and f64 y (mm) of each vertex of the flat sheet, shifted; f64
/// certified_deg; f64 asked_deg; u32 length of `end` and its bytes; the same of `place`; u8
/// contact; u32 intervals; u32 length of `proof` and its bytes. `seconds` is left out.
std::string certificate_hash(const Pattern& base, const Eigen::Matrix2Xd& shifts_mm,
                             const CertificateRecord& row);

/// Returns the record of a certificate that solver::Certifier made in `seconds` of the base with
/// these shifts.
CertificateRecord certificate_row(const Pattern& base, const solver::Mechanism& mechanism,
                                  std::uint64_t draw, const Eigen::Matrix2Xd& shifts_mm,
                                  const solver::Certificate& certificate, double seconds);

/// Returns what is wrong with a record, "its hash is not that of ..."; none if its hash fits and
/// its columns are those of its proof. The proof itself is checked by solver::check_certificate.
std::optional<std::string> certificate_fault(const Pattern& base,
                                             const solver::Mechanism& mechanism,
                                             const Eigen::Matrix2Xd& shifts_mm,
                                             const CertificateRecord& row);

/// Returns what the proof of a row proves: of diagonals where it does not say.
solver::CertifiedBy criterion_of(const CertificateRecord& row);
/// Names the certificate of a row, whose proof is removed.
NamedCertificate named_certificate(std::string name, CertificateRecord row, bool is_new);

/// Returns {"certified_deg", "asked_deg", "by", "end", "where", "contact", "intervals", "seconds",
/// "hash", "proof"}; the place is null where there is none, the proof in base64.
Json certificate_json(const CertificateRecord& row);

/// Reads the certificate of a pattern file (PatternFile::exported), none where it has none.
/// UserError (bad_input) naming `source` if it is malformed.
std::optional<CertificateRecord> certificate_of_json(const Json& exported,
                                                     const std::string& source);

/// Reads a candidate's certificate, if it has one. The hash is empty where a column has an
/// impossible value, so that certificate_fault finds it. UserError (bad_input) if the file cannot
/// be read.
std::optional<CertificateRecord> read_certificate(SQLite::Database& database, std::uint64_t draw);

/// Writes certificates within the caller's transaction, replacing earlier ones. Returns the draws
/// that are no candidates, whose certificates are not stored. Throws SQLite::Exception.
std::vector<std::uint64_t> write_certificates(SQLite::Database& database,
                                              const std::vector<CertificateRecord>& rows);

}  // namespace misalign::schema
