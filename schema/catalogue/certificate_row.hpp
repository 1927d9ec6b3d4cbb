// The certificates that `misalign certify` has made, stored in a catalogue or in a pattern's file.
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

/// XXH3-128 (32 hex digits) of these bytes, all numbers little-endian: u64 draw; u32 vertices, then
/// f64 x and f64 y (mm) of each vertex of the flat sheet, shifted; f64 certified_deg; f64
/// asked_deg; u32 length of `end` and its bytes; the same of `place`; u8 contact; u32 intervals;
/// u32 length of `proof` and its bytes. Not of `seconds`.
std::string certificate_hash(const Pattern& base, const Eigen::Matrix2Xd& shifts_mm,
                             const CertificateRecord& row);

/// Of the base with these shifts, made by solver::Certifier in `seconds`.
CertificateRecord certificate_row(const Pattern& base, const solver::Mechanism& mechanism,
                                  std::uint64_t draw, const Eigen::Matrix2Xd& shifts_mm,
                                  const solver::Certificate& certificate, double seconds);

/// None where the row keeps its hash and its proof says what its columns say; otherwise what is
/// wrong: "its hash is not that of ...". Whether the proof is one, solver::check_certificate says.
std::optional<std::string> certificate_fault(const Pattern& base,
                                             const solver::Mechanism& mechanism,
                                             const Eigen::Matrix2Xd& shifts_mm,
                                             const CertificateRecord& row);

/// {"certified_deg", "asked_deg", "end", "where", "contact", "intervals", "seconds", "hash",
/// "proof"}: the place, null where there is none, and the proof in base64.
Json certificate_json(const CertificateRecord& row);

/// That of a pattern file (PatternFile::exported); none where it has none. UserError (bad_input)
/// naming `source` if it is not written as one.
std::optional<CertificateRecord> certificate_of_json(const Json& exported,
                                                     const std::string& source);

/// A candidate's, if it has one. Where a column holds what no certificate's can, the hash is empty,
/// so that certificate_fault finds it. UserError (bad_input) if the file cannot be read.
std::optional<CertificateRecord> read_certificate(SQLite::Database& database, std::uint64_t draw);

/// Within its caller's transaction; each takes the place of the one that was there. Of draws that
/// are no candidates nothing is kept, and these are returned. Throws SQLite::Exception.
std::vector<std::uint64_t> write_certificates(SQLite::Database& database,
                                              const std::vector<CertificateRecord>& rows);

}  // namespace misalign::schema
