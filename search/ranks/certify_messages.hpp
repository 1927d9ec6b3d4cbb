// The messages of `misalign certify` between ranks, as bytes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "search/ranks/wire.hpp"
#include "search/sheets/row_certifier.hpp"

namespace misalign::search {

/// What a worker is to do with one sheet.
struct CertifyOrder {
  std::uint64_t draw = 0;
  double asked_deg = 0;
  Eigen::Matrix2Xd shifts_mm;                            ///< one column per vertex of the sheet
  std::optional<schema::CertificateRecord> stored = {};  ///< to be checked, instead of made
};

/// What came of it: a certificate that was made, or what is wrong with the one that was checked.
struct CertifyResult {
  std::optional<schema::CertificateRecord> made;
  std::optional<schema::CertificateFinding> finding;
};

/// What a worker sends back of its sheets: of the first ones, all if it was not interrupted.
struct SentResults {
  std::vector<CertifyResult> results;
  double seconds = 0;
  bool was_stopped = false;  ///< by a signal
};

/// How these are laid out: ranks of two builds understand each other where this is the same.
std::string certify_layout();

Bytes pack(const std::vector<CertifyOrder>& orders);
std::vector<CertifyOrder> unpack_orders(const Bytes& bytes);
Bytes pack(const SentResults& sent);
SentResults unpack_results(const Bytes& bytes);

}  // namespace misalign::search
