// Packs the messages of `misalign certify` between ranks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "search/ranks/wire.hpp"
#include "search/sheets/row_certifier.hpp"

namespace misalign::search {

/// A worker's order for one sheet.
struct CertifyOrder {
  std::uint64_t draw = 0;
  double asked_deg = 0;
  Eigen::Matrix2Xd shifts_mm;  ///< one column per vertex of the sheet
  std::optional<schema::CertificateRecord> stored =
      {};  ///< the certificate to check; none to make one
};

/// The result: a certificate that was made, or a finding about the checked one.
struct CertifyResult {
  std::optional<schema::CertificateRecord> made;
  std::optional<schema::CertificateFinding> finding;
};

/// Results of a worker's first sheets; of all sheets unless it was interrupted.
struct SentResults {
  std::vector<CertifyResult> results;
  double seconds = 0;
  bool was_stopped = false;  ///< true if a signal stopped it
};

/// Names the layout of these messages: ranks of two builds can work together if it is the same.
std::string certify_layout();

Bytes pack(const std::vector<CertifyOrder>& orders);
std::vector<CertifyOrder> unpack_orders(const Bytes& bytes);
Bytes pack(const SentResults& sent);
SentResults unpack_results(const Bytes& bytes);

}  // namespace misalign::search
