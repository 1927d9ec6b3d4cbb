// The certificates of `misalign certify`, as JSON.
#pragma once

#include "schema/files/input.hpp"
#include "schema/records/certificate_record.hpp"

namespace misalign::schema {

/// The row as certificate_json has it, with "bytes" instead of the proof.
Json certified_json(const NamedCertificate& sheet);

Json check_json(const CertificateCheck& check);

}  // namespace misalign::schema
