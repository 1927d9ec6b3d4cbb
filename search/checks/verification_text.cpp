#include "search/checks/verification_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "schema/files/features.hpp"
#include "search/terminal/count_text.hpp"

namespace misalign::search {
namespace {

using schema::Json;

std::string units_text(const Verification& v) {
  if (v.units.checked == 0) {
    return fmt::format(
        "units        0 of {} made again; --units finds a candidate that was removed together with "
        "its sums\n",
        v.units.of);
  }
  const std::string line = fmt::format(
      "units        {} of {} made again, {} draws (--seed {}): a candidate that was removed "
      "together with its sums is found with probability {:.3g}\n",
      v.units.checked, v.units.of, v.draws_again, v.seed, v.chance_to_find_one());
  if (v.decided_now == 0) return line;
  return line + fmt::format(
                    "not compared {} of them: undecided either in the catalogue or now (no fault; "
                    "`misalign search --retry-undecided` judges them again)\n",
                    count_text(v.decided_now, "draw"));
}

std::string memory_text(const MemoryReport& memory) {
  if (memory.current + memory.stale == 0) return "";
  return fmt::format(
      "remembered   {} of {} numbers of studies computed again; {} of other designs or versions, "
      "not "
      "used\n",
      memory.checked, memory.current, memory.stale);
}

std::string other_definitions_text(const Verification& v) {
  if (v.not_comparable == 0) return "";
  return fmt::format(
      "not compared {} of {} candidates: an older build measured them by another definition (no "
      "fault)\n",
      fmt::join(v.other_definitions, ", "), v.not_comparable);
}

}  // namespace

std::string verification_text(const Verification& v) {
  std::string text = findings_text(v.findings);
  text += fmt::format("campaign     {}, digest {}\n", v.campaign, v.digest);
  text += fmt::format("candidates   {} of {} computed again\n", v.checked.size(), v.candidates);
  text += fmt::format("fault sample {} of {} judged again\n", v.fault_samples.checked,
                      v.fault_samples.of);
  if (v.certificates.of > 0) {
    text += fmt::format(
        "certificates {} of {} have the right hash (`misalign certify --check` checks their "
        "proofs)\n",
        v.certificates.checked, v.certificates.of);
  }
  text += memory_text(v.memory) + units_text(v) + other_definitions_text(v);
  text += "errors       " + worst_text(v.worst, v.diagonal_mm) + "\n";
  if (const CheckedCandidate* first = v.first_contact()) {
    text +=
        fmt::format("crossings    panels cross in {} candidates, first at {:g} deg (draw {}, {})\n",
                    v.contacts(), *first->first_contact_deg, first->draw, first->contact);
  } else {
    text += no_contacts_text();
  }
  if (const CheckedCandidate* first = v.first_meeting()) {
    const auto meeting = std::count_if(v.checked.begin(), v.checked.end(),
                                       [](const CheckedCandidate& c) { return !c.meet.is_null(); });
    text += fmt::format("any angle    panels meet in {} candidates; draw {}: {}\n", meeting,
                        first->draw, first->meet_text);
  } else {
    text += "any angle    no panels meet up to D, as far as the paths are resolved\n";
  }
  return text + "findings     " + (v.good() ? "none" : std::to_string(v.findings.size())) + "\n";
}

Json verification_json(const Verification& v) {
  Json checked = Json::array();
  for (const CheckedCandidate& candidate : v.checked) {
    const bool crosses = candidate.first_contact_deg.has_value();
    checked.push_back({{"draw", candidate.draw},
                       {"first_contact_deg", crosses ? Json(*candidate.first_contact_deg) : Json()},
                       {"panels", crosses ? Json(candidate.contact) : Json()},
                       {"contact", candidate.meet},
                       {"contact_known_until_deg", candidate.met_until_deg}});
  }
  return {{"campaign", v.campaign},
          {"digest", v.digest},
          {"candidates", v.candidates},
          {"checked", checked},
          {"panels_checked", has("FCL")},
          {"fault_samples", {{"checked", v.fault_samples.checked}, {"of", v.fault_samples.of}}},
          {"certificates", {{"good", v.certificates.checked}, {"of", v.certificates.of}}},
          {"remembered",
           {{"checked", v.memory.checked}, {"of", v.memory.current}, {"stale", v.memory.stale}}},
          {"units",
           {{"checked", v.units.checked},
            {"of", v.units.of},
            {"draws", v.draws_again},
            {"decided_now", v.decided_now},
            {"seed", v.units.checked > 0 ? Json(v.seed) : Json()},
            {"chance_to_find_one", v.chance_to_find_one()}}},
          {"not_comparable",
           {{"candidates", v.not_comparable}, {"columns", Json(v.other_definitions)}}},
          {"good", v.good()},
          {"findings", findings_json(v.findings)},
          {"worst", worst_json(v.worst, v.diagonal_mm)}};
}

}  // namespace misalign::search
