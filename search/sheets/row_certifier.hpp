// Certificates of a campaign's sheets, or of a pattern's, as rows: made, and checked again.
#pragma once

#include <optional>

#include "schema/catalogue/certificate_row.hpp"
#include "search/draws/parts.hpp"
#include "solver/certificate/certifier.hpp"
#include "solver/model/model.hpp"

namespace misalign::search {

class RowCertifier {
 public:
  /// Both must outlive this object; shifts of the base itself do not matter.
  RowCertifier(const schema::Pattern& base, const solver::Model& model, bool contact = false);

  /// Certifies from flat to `asked_deg`, or as far as a proof exists. One column of shifts per
  /// vertex.
  schema::CertificateRecord certify(std::uint64_t draw, const Eigen::Matrix2Xd& shifts_mm,
                                    double asked_deg);

  /// The fault where hash or columns are not those of this sheet's proof.
  std::optional<schema::CertificateFinding> row_fault(const Eigen::Matrix2Xd& shifts_mm,
                                                      const schema::CertificateRecord& row) const;
  /// The same, or a fault of the proof itself: the second opinion, in ball arithmetic.
  /// UserError (failure) where this build is without FLINT.
  std::optional<schema::CertificateFinding> check(const Eigen::Matrix2Xd& shifts_mm,
                                                  const schema::CertificateRecord& row) const;

 private:
  const schema::Pattern& base_;
  const solver::Model& model_;
  solver::Certifier certifier_;
};

/// Returns whether a certificate answers the request: no other would say more.
bool answers(const schema::CertificateRecord& row, double asked_deg, bool contact);

/// Certifies accepted draws of a campaign.
CertifyDraw draw_certifier(const schema::Campaign& campaign, const solver::Model& model);

}  // namespace misalign::search
