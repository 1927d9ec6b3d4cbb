// The certificates of `misalign certify`, as text.
#pragma once

#include <string>
#include <vector>

#include "schema/records/certificate_record.hpp"

namespace misalign::search {

/// One line: "draw 7: certified from flat to 171 deg, ...".
std::string certified_text(const schema::NamedCertificate& sheet);
/// A line each of a few, a summary of many: how many end for which reason, how far, what they cost.
std::string certified_text(const std::vector<schema::NamedCertificate>& sheets);

std::string check_text(const schema::CertificateCheck& check);

}  // namespace misalign::search
