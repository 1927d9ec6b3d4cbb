#include "search/sheets/row_certifier.hpp"

#include <cassert>

#include "schema/files/features.hpp"
#include "search/sheets/springs_at_vertices.hpp"
#include "search/terminal/stopwatch.hpp"
#include "solver/certificate/certificate_check.hpp"

namespace misalign::search {

namespace {

const solver::Model& with_loops_to_close(const solver::Model& model) {
  need_springs_in_mid_plane(model.base().springs, "certify: proofs");
  if (!model.is_overconstrained()) return model;
  throw schema::UserError(
      schema::Cause::bad_request,
      "certify: overconstrained sheets are proven in closed form alone, which keeps no "
      "certificate; `misalign certify` of a file or a draw proves them");
}

// The filling whose energy is proven to fall to flat; none if every diagonal is monotone.
std::optional<solver::Fill> fill_of(const solver::Model& model, const CertifiedClaims& claims) {
  if (claims.criterion != solver::CertifiedBy::energy) return std::nullopt;
  assert(claims.fill);
  const char* const why = solver::why_not_certifiable(*claims.fill, model.mechanism().springs);
  if (why == nullptr) return claims.fill;
  throw schema::UserError(
      schema::Cause::bad_request,
      std::string("certify: no proof that this energy falls to flat is possible (") + why +
          "); change the filling, or give " + schema::parameter("criterion", "diagonals"));
}

}  // namespace

CertifiedClaims claims_of(const schema::Pattern& base, const schema::Sampling& sampling,
                          const schema::Design& design,
                          const std::optional<solver::CertifiedBy>& criterion, bool contact) {
  const auto& judged_fill = sampling.energy_of;
  const solver::CertifiedBy its_criterion =
      judged_fill ? solver::CertifiedBy::energy : solver::CertifiedBy::diagonals;
  return {contact, criterion.value_or(its_criterion),
          judged_fill ? *judged_fill : design.fill(base.base), !judged_fill};
}

CertifiedClaims claims_of(const schema::Campaign& campaign,
                          const std::optional<solver::CertifiedBy>& criterion, bool contact) {
  return claims_of(campaign.pattern, campaign.sampling(), campaign.design, criterion, contact);
}

RowCertifier::RowCertifier(const schema::Pattern& base, const solver::Model& model,
                           const CertifiedClaims& claims)
    : base_(base),
      model_(model),
      claims_(claims),
      certifier_(with_loops_to_close(model), claims.contact, fill_of(model, claims)) {}

schema::CertificateRecord RowCertifier::certify(std::uint64_t draw,
                                                const Eigen::Matrix2Xd& shifts_mm,
                                                double asked_deg) {
  const Stopwatch watch;
  const solver::FlatVertices vertices_mm = base_.base.sheet.vertices_mm + shifts_mm;
  const solver::Certificate certificate = certifier_.certify(vertices_mm, asked_deg);
  return schema::certificate_row(base_, model_.mechanism(), draw, shifts_mm, certificate,
                                 watch.seconds());
}

std::optional<schema::CertificateFinding> RowCertifier::row_fault(
    const Eigen::Matrix2Xd& shifts_mm, const schema::CertificateRecord& row) const {
  const auto fault = schema::certificate_fault(base_, model_.mechanism(), shifts_mm, row);
  if (!fault) return std::nullopt;
  return schema::CertificateFinding{row.draw, {}, *fault};
}

std::optional<schema::CertificateFinding> RowCertifier::check(
    const Eigen::Matrix2Xd& shifts_mm, const schema::CertificateRecord& row) const {
  schema::need("FLINT");
  if (const auto fault = row_fault(shifts_mm, row)) return fault;
  if constexpr (has("FLINT")) {
    const auto certificate = solver::decode(model_.mechanism(), row.proof);
    const solver::FlatVertices vertices_mm = base_.base.sheet.vertices_mm + shifts_mm;
    const auto fault = solver::check_certificate(model_, vertices_mm, *certificate, claims_.fill);
    if (fault)
      return schema::CertificateFinding{row.draw, {{fault->from_deg, fault->to_deg}}, fault->what};
  }
  return std::nullopt;
}

bool answers(const schema::CertificateRecord& row, double asked_deg,
             const CertifiedClaims& claims) {
  if (claims.criterion == solver::CertifiedBy::energy && claims.fill_of_design) return false;
  const bool ends_for_contact = row.end == solver::name_of(solver::CertificateEnd::contact);
  return row.asked_deg >= asked_deg && schema::criterion_of(row) == claims.criterion &&
         (row.contact == claims.contact || (row.contact && !ends_for_contact));
}

CertifyDraw draw_certifier(const schema::Campaign& campaign, const solver::Model& model) {
  return [certifier = std::make_shared<RowCertifier>(campaign.pattern, model, claims_of(campaign))](
             std::uint64_t draw, const Eigen::Matrix2Xd& shifts_mm, double deploys_from_deg) {
    return certifier->certify(draw, shifts_mm, deploys_from_deg);
  };
}

}  // namespace misalign::search
