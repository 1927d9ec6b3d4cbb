// The certificates of `misalign certify`, as text and as JSON.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "search/sheets/sheet_certifier.hpp"

namespace misalign::search {

/// A sheet's certificate, without its proof.
struct CertifiedSheet {
  std::string name;  ///< "draw 7", or a pattern's
  schema::CertificateRecord row;
  std::size_t bytes;    ///< of the proof
  bool is_new = false;  ///< made now, not there already
};

/// Of a row, whose proof is taken out.
CertifiedSheet certified_sheet(std::string name, schema::CertificateRecord row, bool is_new);

/// One line: "draw 7: certified from flat to 171 deg, ...".
std::string certified_text(const CertifiedSheet& sheet);
/// A line each of a few, a summary of many: how many end for which reason, how far, what they cost.
std::string certified_text(const std::vector<CertifiedSheet>& sheets);

/// The row as schema::certificate_json has it, with "bytes" instead of the proof.
schema::Json certified_json(const CertifiedSheet& sheet);

/// What came of checking the certificates of a catalogue's candidates, or of a pattern.
struct CertificateCheck {
  std::uint64_t checked = 0, of = 0;
  std::uint64_t without = 0;  ///< candidates that have no certificate
  std::vector<CertificateFinding> findings;
  std::map<std::string, std::uint64_t> ends = {};  ///< of those that hold, by name
};

std::string check_text(const CertificateCheck& check);
schema::Json check_json(const CertificateCheck& check);

}  // namespace misalign::search
