// The certificates of `misalign certify`, as text.
#pragma once

#include <string>
#include <vector>

#include "schema/pattern/pattern.hpp"
#include "schema/records/certificate_record.hpp"
#include "solver/certificate/energy_wells.hpp"
#include "solver/certificate/member_proof.hpp"

namespace misalign::search {

/// One line: "draw 7: certified from flat to 171 deg, ...".
std::string certified_text(const schema::NamedCertificate& sheet);
/// A line each of a few, a summary of many: reasons of their ends, angles, costs.
std::string certified_text(const std::vector<schema::NamedCertificate>& sheets);

std::string check_text(const schema::CertificateCheck& check);

/// Text of a proof that holds.
std::string member_proof_text(const schema::Pattern& pattern, const std::string& name,
                              const solver::MemberProof& proof, double asked_deg);

/// One line: "table1: one well at 60.00 deg between flat and 150 deg, proven; ...".
std::string wells_text(const solver::Sheet& sheet, const solver::EnergyWells& wells);

}  // namespace misalign::search
