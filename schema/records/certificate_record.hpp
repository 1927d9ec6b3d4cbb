// A certificate as it is kept: what it says, its proof and its hash.
#pragma once

#include <cstdint>
#include <string>

namespace misalign::schema {

/// A candidate's certificate as its catalogue keeps it.
struct CertificateRecord {
  std::uint64_t draw = 0;  ///< 0 for a pattern that no campaign has drawn
  double certified_deg = 0, asked_deg = 0;
  std::string end;  ///< solver::name_of
  /// "A17-A23" of the diagonal or the crease at which it ends, "[0,1] and [2,3]" of two panels;
  /// empty where it ends at none.
  std::string place;
  bool contact = false;         ///< whether it proves that no panels meet as well
  std::uint32_t intervals = 0;  ///< without the closing one
  double seconds = 0;           ///< that making it took; not part of the hash
  std::string proof;            ///< solver::encode
  std::string hash;             ///< certificate_hash

  friend bool operator==(const CertificateRecord&, const CertificateRecord&) = default;
};

/// The proof of one is hardly ever larger than this.
inline constexpr std::size_t kUsualCertificate_bytes = 20000;

}  // namespace misalign::schema
