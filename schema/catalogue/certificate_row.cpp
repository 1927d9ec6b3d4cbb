#include "schema/catalogue/certificate_row.hpp"

#include <sqlite3.h>

#include <bit>
#include <cmath>
#include <limits>

#include "schema/catalogue/database.hpp"
#include "schema/files/base64.hpp"
#include "schema/files/hash.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "solver/model/panel_pairs.hpp"

namespace misalign::schema {
namespace {

using solver::CertificateEnd;
using solver::CertifiedBy;

// Ignores draws that are no candidates.
constexpr const char* kInsertCertificate =
    "INSERT INTO certificate (draw, certified_deg, asked_deg, ended, place, contact, intervals, "
    "seconds, hash, proof) SELECT ?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10 "
    "WHERE EXISTS (SELECT 1 FROM candidate WHERE draw = ?1) "
    "ON CONFLICT (draw) DO UPDATE SET certified_deg = excluded.certified_deg, "
    "asked_deg = excluded.asked_deg, ended = excluded.ended, place = excluded.place, "
    "contact = excluded.contact, intervals = excluded.intervals, seconds = excluded.seconds, "
    "hash = excluded.hash, proof = excluded.proof";
constexpr const char* kSelect =
    "SELECT certified_deg, asked_deg, ended, place, contact, intervals, seconds, hash, proof "
    "FROM certificate WHERE draw = ?";

constexpr const char* kCertificate = "certificate";

template <class Bits>
void put_bits(std::string& bytes, Bits bits) {
  for (std::size_t k = 0; k < sizeof bits; ++k) {
    bytes.push_back(static_cast<char>(bits >> (8 * k) & 0xff));
  }
}

void put(std::string& bytes, double value) { put_bits(bytes, std::bit_cast<std::uint64_t>(value)); }

void put(std::string& bytes, const std::string& text) {
  put_bits(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += text;
}

// "[0,1] and [2,3]"
std::string panels_place(const Pattern& base, const solver::Mechanism& mechanism,
                         std::size_t number) {
  const solver::Panels panels = solver::panels_of(base.base, mechanism);
  const auto pairs = solver::pairs_of(panels);
  if (number >= pairs.size()) return "";
  const auto place_of = [&](int panel) {
    return facet_json(base, panels.facets[static_cast<std::size_t>(panel)]).dump();
  };
  return place_of(pairs[number].a) + " and " + place_of(pairs[number].b);
}

// Returns whether an energy turns back, which no single diagonal does.
bool is_of_all(const solver::Certificate& certificate) {
  return certificate.end == CertificateEnd::reversal &&
         certificate.criterion == CertifiedBy::energy;
}

// Returns the place's label, empty if the sheet has no such place.
std::string place_of(const Pattern& base, const solver::Mechanism& mechanism,
                     const solver::Certificate& certificate) {
  if (certificate.where < 0 || is_of_all(certificate)) return "";
  const auto number = static_cast<std::size_t>(certificate.where);
  switch (certificate.end) {
    case CertificateEnd::reversal:
    case CertificateEnd::unclear_slope:
      if (number >= mechanism.diagonals.size()) return "";
      return solver::line_label(mechanism.diagonals[number].from, mechanism.diagonals[number].to);
    case CertificateEnd::over_folded:
    case CertificateEnd::sign_changed:
      if (number >= mechanism.creases.size()) return "";
      return solver::line_label(mechanism.creases[number].a, mechanism.creases[number].b);
    case CertificateEnd::contact:
      return panels_place(base, mechanism, number);
    case CertificateEnd::to_the_end:
    case CertificateEnd::fold_limit:
    case CertificateEnd::flat_branch:
      break;
  }
  return "";
}

bool needs_place(const solver::Certificate& certificate) {
  const CertificateEnd end = certificate.end;
  return (end == CertificateEnd::reversal && !is_of_all(certificate)) ||
         end == CertificateEnd::over_folded || end == CertificateEnd::sign_changed ||
         end == CertificateEnd::contact;
}

// Returns the columns that follow from a proof, without hash, seconds and the proof itself.
CertificateRecord claims_of(const Pattern& base, const solver::Mechanism& mechanism,
                            std::uint64_t draw, const solver::Certificate& certificate) {
  CertificateRecord row;
  row.draw = draw;
  row.certified_deg = certificate.certified_deg();
  row.asked_deg = certificate.asked_deg;
  row.end = solver::name_of(certificate.end);
  row.place = place_of(base, mechanism, certificate);
  row.contact = certificate.contact;
  row.intervals = static_cast<std::uint32_t>(certificate.intervals.size());
  return row;
}

// Returns whether every column of a row of kSelect has a possible value.
bool is_certificate(SQLite::Statement& row) {
  constexpr int kTypes[] = {SQLITE_FLOAT,   SQLITE_FLOAT, SQLITE_TEXT, SQLITE_TEXT, SQLITE_INTEGER,
                            SQLITE_INTEGER, SQLITE_FLOAT, SQLITE_TEXT, SQLITE_BLOB};
  int column = 0;
  for (const int type : kTypes) {
    if (row.getColumn(column++).getType() != type) return false;
  }
  const std::int64_t contact = row.getColumn(4).getInt64(), intervals = row.getColumn(5).getInt64();
  const double seconds = row.getColumn(6).getDouble();
  return (contact == 0 || contact == 1) && intervals >= 0 &&
         intervals <= std::numeric_limits<std::uint32_t>::max() && std::isfinite(seconds) &&
         seconds >= 0;
}

}  // namespace

std::string certificate_hash(const Pattern& base, const Eigen::Matrix2Xd& shifts_mm,
                             const CertificateRecord& row) {
  const Eigen::Matrix2Xd vertices_mm = base.base.sheet.vertices_mm + shifts_mm;
  std::string bytes;
  put_bits(bytes, row.draw);
  put_bits(bytes, static_cast<std::uint32_t>(vertices_mm.cols()));
  for (const double coordinate : vertices_mm.reshaped()) put(bytes, coordinate);
  put(bytes, row.certified_deg);
  put(bytes, row.asked_deg);
  put(bytes, row.end);
  put(bytes, row.place);
  put_bits<std::uint8_t>(bytes, row.contact ? 1 : 0);
  put_bits(bytes, row.intervals);
  put(bytes, row.proof);
  return hex(hash_of(bytes));
}

CertificateRecord certificate_row(const Pattern& base, const solver::Mechanism& mechanism,
                                  std::uint64_t draw, const Eigen::Matrix2Xd& shifts_mm,
                                  const solver::Certificate& certificate, double seconds) {
  CertificateRecord row = claims_of(base, mechanism, draw, certificate);
  row.seconds = seconds;
  row.proof = solver::encode(mechanism, certificate);
  row.hash = certificate_hash(base, shifts_mm, row);
  return row;
}

solver::CertifiedBy criterion_of(const CertificateRecord& row) {
  return solver::certified_by_of(row.proof).value_or(solver::CertifiedBy::diagonals);
}

NamedCertificate named_certificate(std::string name, CertificateRecord row, bool is_new) {
  const std::size_t bytes = row.proof.size();
  const solver::CertifiedBy criterion = criterion_of(row);
  row.proof = {};
  return {std::move(name), std::move(row), bytes, criterion, is_new};
}

std::optional<std::string> certificate_fault(const Pattern& base,
                                             const solver::Mechanism& mechanism,
                                             const Eigen::Matrix2Xd& shifts_mm,
                                             const CertificateRecord& row) {
  if (row.hash != certificate_hash(base, shifts_mm, row)) {
    return "its hash is not that of the sheet, its columns and its proof";
  }
  const auto certificate = solver::decode(mechanism, row.proof);
  if (!certificate) return "its proof cannot belong to such a sheet";
  if (certificate->certified_deg() > certificate->asked_deg) {
    return "its proof goes beyond the requested angle";
  }
  const CertificateRecord claims = claims_of(base, mechanism, row.draw, *certificate);
  const auto contradicted = [](const std::string& column) {
    return "its proof contradicts its column " + column;
  };
  if (row.certified_deg != claims.certified_deg) return contradicted("certified_deg");
  if (row.asked_deg != claims.asked_deg) return contradicted("asked_deg");
  if (row.end != claims.end) return contradicted("ended");
  if (row.place != claims.place) return contradicted("place");
  if (claims.place.empty() && needs_place(*certificate)) {
    return "its proof ends at a place that the sheet does not have";
  }
  if (row.contact != claims.contact) return contradicted("contact");
  if (row.intervals != claims.intervals) return contradicted("intervals");
  return std::nullopt;
}

Json certificate_json(const CertificateRecord& row) {
  return {{"certified_deg", row.certified_deg},
          {"asked_deg", row.asked_deg},
          {"by", solver::name_of(criterion_of(row))},
          {"end", row.end},
          {"where", row.place.empty() ? Json() : Json(row.place)},
          {"contact", row.contact},
          {"intervals", row.intervals},
          {"seconds", row.seconds},
          {"hash", row.hash},
          {"proof",
           base64(reinterpret_cast<const unsigned char*>(row.proof.data()), row.proof.size())}};
}

std::optional<CertificateRecord> certificate_of_json(const Json& exported,
                                                     const std::string& source) {
  const auto value = exported.is_object() ? exported.find(kCertificate) : exported.end();
  if (!exported.is_object() || value == exported.end() || value->is_null()) return std::nullopt;
  InputFaults faults;
  CertificateRecord row;
  const std::string again = "export the candidate again, or run `misalign certify`";
  if (const auto draw = exported.find("draw"); draw != exported.end()) {
    ObjectReader(exported, "", faults).whole("draw", row.draw, kEndOfDraws, again);
  }
  ObjectReader reader(*value, kCertificate, faults);
  for (const char* key : {"certified_deg", "asked_deg", "end", "where", "contact", "intervals",
                          "seconds", "hash", "proof"}) {
    reader.require(key, again);
  }
  reader.number("certified_deg", row.certified_deg, 0, 180, again);
  reader.number("asked_deg", row.asked_deg, 0, 180, again);
  const Json* const criterion = reader.said("by");  // older ones have none
  reader.text("end", row.end, again);
  if (reader.said("where")) reader.text("where", row.place, again);
  reader.boolean("contact", row.contact, again);
  std::uint64_t intervals = 0;
  reader.whole("intervals", intervals, std::numeric_limits<std::uint32_t>::max(), again);
  row.intervals = static_cast<std::uint32_t>(intervals);
  reader.number("seconds", row.seconds, 0, std::numeric_limits<double>::max(), again);
  reader.text("hash", row.hash, again);
  std::string proof;
  reader.text("proof", proof, again);
  const auto bytes = from_base64(proof);
  if (!bytes) faults.add(reader.name("proof"), "is not base64", again);
  if (bytes) row.proof = *bytes;
  if (criterion && *criterion != solver::name_of(criterion_of(row))) {
    faults.add(reader.shown("by"), "contradicts the proof", again);
  }
  reader.refuse_unknown_keys();
  faults.refuse(source);
  return row;
}

std::optional<CertificateRecord> read_certificate(SQLite::Database& database, std::uint64_t draw) {
  return reading(database, [&]() -> std::optional<CertificateRecord> {
    SQLite::Statement row = bound(database, kSelect, draw);
    if (!row.executeStep()) return std::nullopt;
    const bool good = is_certificate(row);
    return CertificateRecord{draw,
                             row.getColumn(0).getDouble(),
                             row.getColumn(1).getDouble(),
                             text_of(row.getColumn(2)),
                             text_of(row.getColumn(3)),
                             row.getColumn(4).getInt64() == 1,
                             row.getColumn(5).getUInt(),
                             good ? row.getColumn(6).getDouble() : 0,
                             row.getColumn(8).getString(),
                             good ? text_of(row.getColumn(7)) : ""};
  });
}

std::vector<std::uint64_t> write_certificates(SQLite::Database& database,
                                              const std::vector<CertificateRecord>& rows) {
  std::vector<std::uint64_t> no_candidates;
  SQLite::Statement insert(database, kInsertCertificate);
  for (const CertificateRecord& row : rows) {
    const int changed =
        execute(insert, row.draw, row.certified_deg, row.asked_deg, row.end, row.place,
                row.contact ? 1 : 0, row.intervals, row.seconds, row.hash, Blob(row.proof));
    if (changed == 0) no_candidates.push_back(row.draw);
  }
  return no_candidates;
}

}  // namespace misalign::schema
