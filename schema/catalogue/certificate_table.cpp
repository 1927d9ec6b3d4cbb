#include "schema/catalogue/certificate_table.hpp"

#include <functional>
#include <utility>

#include "schema/catalogue/candidate_row.hpp"

namespace misalign::schema {
namespace {

// Of a candidate as it is stored; none where there is no such candidate, or no such sheet.
std::optional<Eigen::Matrix2Xd> stored_shifts(SQLite::Database& database, const Campaign& campaign,
                                              std::uint64_t draw) {
  return reading(database, [&]() -> std::optional<Eigen::Matrix2Xd> {
    SQLite::Statement row(database, "SELECT displacements_mm FROM candidate WHERE draw = ?");
    row.bind(1, stored(draw));
    if (!row.executeStep()) return std::nullopt;
    return read_shifts(text_of(row.getColumn(0)), campaign.pattern.base.sheet.vertex_count());
  });
}

void each_certificate(SQLite::Database& database,
                      const std::function<void(const CertificateRow& row)>& see) {
  if (!reading(database, [&] { return has_certificates(database); })) return;
  for (const std::uint64_t draw : draws_of(database, "certificate", {0, kEndOfDraws})) {
    if (const auto row = read_certificate(database, draw)) see(*row);
  }
}

bool goes_farther(const CertificateRow& row, const CertificateRow& other) {
  return std::pair(row.contact, row.certified_deg) > std::pair(other.contact, other.certified_deg);
}

}  // namespace

CheckedCertificates check_certificates(SQLite::Database& database, const Campaign& campaign) {
  const solver::PerforatedSheet& base = campaign.pattern.base;
  const solver::Mechanism mechanism = solver::build_mechanism(base.sheet, base.holes, base.folding);
  CheckedCertificates checked;
  each_certificate(database, [&](const CertificateRow& row) {
    ++checked.count;
    const auto shifts_mm = stored_shifts(database, campaign, row.draw);
    const std::optional<std::string> fault =
        shifts_mm ? certificate_fault(campaign, mechanism, *shifts_mm, row)
                  : "it is of no sheet that is a candidate";
    if (!fault) return;
    const std::string where = "draw " + std::to_string(row.draw);
    checked.findings.push_back(
        {where + ": its certificate is not as it was made (" + *fault +
             "); `misalign certify` makes it anew",
         {{"where", where}, {"column", "certificate"}, {"stored", row.hash}, {"fault", *fault}}});
  });
  return checked;
}

std::uint64_t copy_certificates(SQLite::Database& from, SQLite::Database& into,
                                const Campaign& campaign, const solver::Mechanism& mechanism) {
  std::uint64_t faulty = 0;
  each_certificate(from, [&](const CertificateRow& row) {
    const auto shifts_mm = stored_shifts(into, campaign, row.draw);
    if (!shifts_mm) return;
    if (certificate_fault(campaign, mechanism, *shifts_mm, row)) {
      ++faulty;
      return;
    }
    const auto there = read_certificate(into, row.draw);
    const bool stays = there && !goes_farther(row, *there) &&
                       !certificate_fault(campaign, mechanism, *shifts_mm, *there);
    if (!stays) write_certificates(into, {row});
  });
  return faulty;
}

}  // namespace misalign::schema
