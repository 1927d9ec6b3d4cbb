// Writes the certificates of `misalign certify` as JSON.
#pragma once

#include "schema/files/input.hpp"
#include "schema/pattern/pattern.hpp"
#include "schema/records/certificate_record.hpp"
#include "solver/certificate/member_proof.hpp"

namespace misalign::schema {

/// certificate_json with "bytes" instead of the proof.
Json certified_json(const NamedCertificate& sheet);

Json check_json(const CertificateCheck& check);

/// {"asked_deg", "certified_deg", "reversing_hole", "member_off_mm", "base_off_mm"}.
Json member_proof_json(const Pattern& pattern, const solver::MemberProof& proof, double asked_deg);

}  // namespace misalign::schema
