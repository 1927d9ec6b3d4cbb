// Records a certificate with its columns, proof and hash, and the findings of a check.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace misalign::solver {
enum class CertifiedBy;
}

namespace misalign::schema {

/// A candidate's certificate, as its catalogue stores it.
struct CertificateRecord {
  std::uint64_t draw = 0;  ///< 0 for a pattern file
  double certified_deg = 0, asked_deg = 0;
  std::string end;  ///< solver::name_of
  /// Place of the end: "A17-A23" of a diagonal or crease, "[0,1] and [2,3]" of two panels; empty
  /// without one.
  std::string place;
  bool contact = false;         ///< true if it also proves that no panels meet
  std::uint32_t intervals = 0;  ///< number without the closing one
  double seconds = 0;           ///< computing time; not part of the hash
  std::string proof;            ///< solver::encode
  std::string hash;             ///< certificate_hash

  friend bool operator==(const CertificateRecord&, const CertificateRecord&) = default;
};

/// Usual upper limit of a proof.
inline constexpr std::size_t kUsualCertificate_bytes = 20000;

/// A sheet's certificate, without its proof.
struct NamedCertificate {
  std::string name;  ///< "draw 7", or a pattern's
  CertificateRecord row;
  std::size_t bytes;  ///< size of the proof
  solver::CertifiedBy criterion;
  bool is_new = false;  ///< made now, not stored before
};

/// A fault that a check finds in a certificate.
struct CertificateFinding {
  struct Interval {
    double from_deg, to_deg;
  };
  std::uint64_t draw = 0;
  std::optional<Interval> interval;  ///< pilot angles; none for a fault of the row itself
  std::string what;

  /// Returns "draw 7, 12.5 to 14 deg: ...".
  std::string sentence() const;
};

/// Result of checking the certificates of a catalogue's candidates, or of a pattern.
struct CertificateCheck {
  std::uint64_t checked = 0, of = 0;
  std::uint64_t without = 0;  ///< candidates without a certificate
  std::vector<CertificateFinding> findings;
  std::map<std::string, std::uint64_t> ends = {};  ///< number of valid certificates by end
};

}  // namespace misalign::schema
