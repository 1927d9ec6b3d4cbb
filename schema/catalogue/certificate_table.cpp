#include "schema/catalogue/certificate_table.hpp"

#include <functional>
#include <utility>

#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/population_rows.hpp"

namespace misalign::schema {
namespace {

// Returns a candidate's stored shifts; none without such a candidate or sheet.
std::optional<Eigen::Matrix2Xd> stored_shifts(SQLite::Database& database, const Campaign& campaign,
                                              std::uint64_t draw) {
  return reading(database, [&]() -> std::optional<Eigen::Matrix2Xd> {
    SQLite::Statement row =
        bound(database, "SELECT displacements_mm FROM candidate WHERE draw = ?", draw);
    if (!row.executeStep()) return std::nullopt;
    return read_shifts(text_of(row.getColumn(0)), campaign.pattern.base.sheet.vertex_count());
  });
}

void each_certificate(SQLite::Database& database,
                      const std::function<void(const CertificateRecord& row)>& see) {
  for (const std::uint64_t draw : draws_of(database, "certificate", {0, kEndOfDraws})) {
    if (const auto row = read_certificate(database, draw)) see(*row);
  }
}

bool goes_farther(const CertificateRecord& row, const CertificateRecord& other) {
  return std::pair(row.contact, row.certified_deg) > std::pair(other.contact, other.certified_deg);
}

// Stores a certificate for that candidate of the same sheet, unless it has a better one. Returns
// false if the certificate has a fault.
bool take_over(CertificateRecord row, SQLite::Database& into, const Campaign& campaign,
               const solver::Mechanism& mechanism, std::uint64_t draw) {
  const auto shifts_mm = stored_shifts(into, campaign, draw);
  if (!shifts_mm) return true;
  if (certificate_fault(campaign.pattern, mechanism, *shifts_mm, row)) return false;
  const auto there = read_certificate(into, draw);
  if (there && !goes_farther(row, *there) &&
      !certificate_fault(campaign.pattern, mechanism, *shifts_mm, *there)) {
    return true;
  }
  if (std::exchange(row.draw, draw) != draw) {
    row.hash = certificate_hash(campaign.pattern, *shifts_mm, row);
  }
  write_certificates(into, {row});
  return true;
}

}  // namespace

CheckedCertificates check_certificates(SQLite::Database& database, const Campaign& campaign) {
  const solver::PerforatedSheet& base = campaign.pattern.base;
  const solver::Mechanism mechanism = solver::build_mechanism(base);
  CheckedCertificates checked;
  each_certificate(database, [&](const CertificateRecord& row) {
    ++checked.count;
    const auto shifts_mm = stored_shifts(database, campaign, row.draw);
    const std::optional<std::string> fault =
        shifts_mm ? certificate_fault(campaign.pattern, mechanism, *shifts_mm, row)
                  : "its sheet is no candidate";
    if (!fault) return;
    const std::string where = "draw " + std::to_string(row.draw);
    checked.findings.push_back(
        {where + ": its certificate is not as it was made (" + *fault +
             "); `misalign certify` makes it anew",
         {{"where", where}, {"column", "certificate"}, {"stored", row.hash}, {"fault", *fault}}});
  });
  return checked;
}

void hand_on_certificate(SQLite::Database& database, const Campaign& campaign,
                         const solver::Mechanism& mechanism, std::uint64_t from, std::uint64_t to) {
  if (auto row = read_certificate(database, from)) {
    take_over(std::move(*row), database, campaign, mechanism, to);
  }
}

std::uint64_t copy_certificates(SQLite::Database& from, SQLite::Database& into,
                                const Campaign& campaign, const solver::Mechanism& mechanism) {
  std::uint64_t faulty = 0;
  each_certificate(from, [&](const CertificateRecord& row) {
    const auto draw = number_in(into, from, row.draw);
    if (draw && !take_over(row, into, campaign, mechanism, *draw)) ++faulty;
  });
  return faulty;
}

}  // namespace misalign::schema
