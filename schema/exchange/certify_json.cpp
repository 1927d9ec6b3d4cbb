#include "schema/exchange/certify_json.hpp"

#include "schema/catalogue/certificate_row.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::schema {

Json certified_json(const NamedCertificate& sheet) {
  Json json = certificate_json(sheet.row);
  json.erase("proof");
  json["by"] = solver::name_of(sheet.criterion);
  json["bytes"] = sheet.bytes;
  return json;
}

Json check_json(const CertificateCheck& check) {
  Json findings = Json::array();
  for (const CertificateFinding& finding : check.findings) {
    const auto& interval = finding.interval;
    findings.push_back({{"draw", finding.draw},
                        {"from_deg", interval ? Json(interval->from_deg) : Json()},
                        {"to_deg", interval ? Json(interval->to_deg) : Json()},
                        {"what", finding.what}});
  }
  Json ends = {{"proven", Json::object()}, {"unproven", Json::object()}};
  for (const auto& [end, certificates] : check.ends) {
    ends[solver::is_proven(end) ? "proven" : "unproven"][end] = certificates;
  }
  return {{"checked", check.checked}, {"of", check.of},
          {"without", check.without}, {"ends", ends},
          {"findings", findings},     {"good", check.findings.empty()}};
}

Json member_proof_json(const Pattern& pattern, const solver::MemberProof& proof, double asked_deg) {
  const bool reverses = proof.reversing_hole >= 0;
  return {{"asked_deg", asked_deg},
          {"certified_deg", proof.certified_deg},
          {"reversing_hole", reverses ? facet_json(pattern, proof.reversing_hole) : Json()},
          {"member_off_mm", proof.member_off_mm},
          {"base_off_mm", proof.base_off_mm}};
}

}  // namespace misalign::schema
