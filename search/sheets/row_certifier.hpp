// Certificates of a campaign's sheets, or of a pattern's, as rows: made, and checked again.
#pragma once

#include <optional>

#include "schema/catalogue/certificate_row.hpp"
#include "search/draws/parts.hpp"
#include "solver/certificate/certifier.hpp"
#include "solver/model/model.hpp"

namespace misalign::search {

/// The claims of certificates beside the path.
struct CertifiedClaims {
  bool contact = false;  ///< true: panels are proven not to meet
  solver::CertifiedBy criterion = solver::CertifiedBy::diagonals;
  std::optional<solver::Fill> fill = {};  ///< filling of the energy criterion; also for checks
  bool fill_of_design = true;             ///< false: the filling that the campaign judges by
};

/// Claims by `criterion`, or else by the sheet's criterion; of the energy of the filling that
/// judges it, or else of the design's.
CertifiedClaims claims_of(const schema::Pattern& base, const schema::Sampling& sampling,
                          const schema::Design& design,
                          const std::optional<solver::CertifiedBy>& criterion = {},
                          bool contact = false);
CertifiedClaims claims_of(const schema::Campaign& campaign,
                          const std::optional<solver::CertifiedBy>& criterion = {},
                          bool contact = false);

class RowCertifier {
 public:
  /// Both must outlive this object; shifts of the base itself do not matter. UserError
  /// (bad_request) for a filling whose energy no certificate proves to rise.
  RowCertifier(const schema::Pattern& base, const solver::Model& model,
               const CertifiedClaims& claims = {});

  /// Certifies from flat to `asked_deg`, or as far as a proof exists. One column of shifts per
  /// vertex.
  schema::CertificateRecord certify(std::uint64_t draw, const Eigen::Matrix2Xd& shifts_mm,
                                    double asked_deg);

  const CertifiedClaims& claims() const { return claims_; }

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
  const CertifiedClaims claims_;
  solver::Certifier certifier_;
};

/// Returns whether a certificate answers the request: no other would say more. None by energy does
/// of a design's filling, which may have changed since.
bool answers(const schema::CertificateRecord& row, double asked_deg, const CertifiedClaims& claims);

/// Certifies accepted draws of a campaign.
CertifyDraw draw_certifier(const schema::Campaign& campaign, const solver::Model& model);

}  // namespace misalign::search
