// Writes the certificates of `misalign certify` as JSON.
#pragma once

#include "schema/files/input.hpp"
#include "schema/pattern/pattern.hpp"
#include "schema/records/certificate_record.hpp"
#include "solver/certificate/energy_wells.hpp"
#include "solver/certificate/member_proof.hpp"

namespace misalign::schema {

/// certificate_json with "bytes" instead of the proof.
Json certified_json(const NamedCertificate& sheet);

Json check_json(const CertificateCheck& check);

/// {"asked_deg", "certified_deg", "reversing_hole", "member_off_mm", "base_off_mm"}.
Json member_proof_json(const Pattern& pattern, const solver::MemberProof& proof, double asked_deg);

/// The crease at which a proof of wells ends, "A17-A23"; empty where it ends for no crease.
std::string crease_place(const solver::Mechanism& mechanism, const solver::EnergyWells& wells);

/// {"asked_deg", "proven_deg", "end", "place", "flat", "flat_n_mm", "wells", "points": [{"kind",
/// "from_deg", "to_deg", "n_mm", "error_n_mm"}, ...]}.
Json wells_json(const solver::Mechanism& mechanism, const solver::EnergyWells& wells);

}  // namespace misalign::schema
