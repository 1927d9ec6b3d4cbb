#include "schema/exchange/certify_json.hpp"

#include "schema/catalogue/certificate_row.hpp"
#include "schema/files/json_values.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "solver/records/certificate.hpp"

namespace misalign::schema {

std::string crease_place(const solver::Mechanism& mechanism, const solver::EnergyWells& wells) {
  if (wells.where < 0) return "";
  const solver::Crease& crease = mechanism.creases[static_cast<std::size_t>(wells.where)];
  return solver::line_label(crease.a, crease.b);
}

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

Json wells_json(const solver::Mechanism& mechanism, const solver::EnergyWells& wells) {
  return {{"asked_deg", wells.asked_deg},
          {"proven_deg", wells.proven_deg},
          {"end", solver::name_of(wells.end)},
          {"place", crease_place(mechanism, wells)},
          {"flat", wells.flat ? Json(solver::name_of(*wells.flat)) : Json()},
          {"flat_n_mm", wells.flat ? Json(wells.flat_energy.n_mm) : Json()},
          {"wells", wells.wells()},
          {"points", json_list(wells.points, [](const solver::StationaryPoint& point) {
             return Json{{"kind", solver::name_of(point.kind)},
                         {"from_deg", point.from_deg},
                         {"to_deg", point.to_deg},
                         {"n_mm", point.energy.n_mm},
                         {"error_n_mm", point.energy.error_n_mm}};
           })}};
}

}  // namespace misalign::schema
