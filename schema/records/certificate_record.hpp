// A certificate as it is kept: what it says, its proof and its hash; and what a check finds.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

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

/// A sheet's certificate, without its proof.
struct NamedCertificate {
  std::string name;  ///< "draw 7", or a pattern's
  CertificateRecord row;
  std::size_t bytes;    ///< of the proof
  bool is_new = false;  ///< made now, not there already
};

/// Of a row, whose proof is taken out.
NamedCertificate named_certificate(std::string name, CertificateRecord row, bool is_new);

/// What a check finds wrong with a certificate.
struct CertificateFinding {
  struct Interval {
    double from_deg, to_deg;
  };
  std::uint64_t draw = 0;
  std::optional<Interval> interval;  ///< of pilot angles; none where it is the row itself
  std::string what;

  /// "draw 7, 12.5 to 14 deg: ...".
  std::string sentence() const;
};

/// What came of checking the certificates of a catalogue's candidates, or of a pattern.
struct CertificateCheck {
  std::uint64_t checked = 0, of = 0;
  std::uint64_t without = 0;  ///< candidates that have no certificate
  std::vector<CertificateFinding> findings;
  std::map<std::string, std::uint64_t> ends = {};  ///< of those that hold, by name
};

}  // namespace misalign::schema
