#include "search/verify.hpp"

#include <algorithm>
#include <cstdio>

namespace misalign::search {
namespace {

using schema::Json;

void add(const CandidateReport& report, std::uint64_t draw, Verification& verification) {
  verification.checked.push_back({draw, report.first_contact_deg, report.contact});
  verification.findings.insert(verification.findings.end(), report.findings.begin(),
                               report.findings.end());
  const auto raise = [](double& worst, double value) { worst = std::max(worst, value); };
  raise(verification.worst.length_mm, report.shape.length_mm);
  raise(verification.worst.planarity_mm, report.shape.planarity_mm);
  raise(verification.worst.coincidence_mm, report.shape.coincidence_mm);
  raise(verification.worst.angle_deg, report.shape.angle_deg);
  raise(verification.diagonal_mm, report.diagonal_mm);
}

}  // namespace

std::uint64_t Verification::contacts() const {
  return static_cast<std::uint64_t>(
      std::count_if(checked.begin(), checked.end(),
                    [](const CheckedCandidate& c) { return c.first_contact_deg.has_value(); }));
}

const CheckedCandidate* Verification::first_contact() const {
  const CheckedCandidate* first = nullptr;
  for (const CheckedCandidate& candidate : checked) {
    if (!candidate.first_contact_deg) continue;
    if (!first || *candidate.first_contact_deg < *first->first_contact_deg) first = &candidate;
  }
  return first;
}

Verification verify(SQLite::Database& database, const std::string& path,
                    std::optional<std::uint64_t> sample) {
  const schema::Campaign campaign = schema::read_campaign_of(database, path);
  Verification verification;
  verification.campaign = campaign.name;
  try {
    verification.findings = schema::check_ledger(database, campaign);
    verification.digest = schema::read_state(database).digest;
    const std::vector<std::uint64_t> draws =
        schema::draws_of(database, "candidate", {0, schema::kEndOfDraws});
    verification.candidates = draws.size();
    const std::uint64_t chosen =
        std::min<std::uint64_t>(sample.value_or(draws.size()), draws.size());
    const CandidateCheck check(campaign);
    for (std::uint64_t k = 0; k < chosen; ++k) {
      const std::uint64_t draw = draws[k * draws.size() / chosen];
      add(check.check(schema::read_candidate(database, draw),
                      schema::schema_version_of(database, draw)),
          draw, verification);
    }
  } catch (const schema::UserError& error) {  // it cannot be read any further
    verification.findings.push_back({error.what(), {{"where", "file"}}});
  }
  return verification;
}

std::string verification_text(const Verification& v) {
  std::string text;
  const std::size_t shown = std::min(v.findings.size(), schema::kMostListed);
  for (std::size_t k = 0; k < shown; ++k) {
    text += schema::printable(v.findings[k].sentence) + "\n";
  }
  if (v.findings.size() > shown) {
    text += "and " + std::to_string(v.findings.size() - shown) + " more; --json has them all\n";
  }
  char line[200];
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::snprintf(line, sizeof line, "campaign     %s, digest %s\n", v.campaign.c_str(),
                v.digest.c_str());
  text += line;
  std::snprintf(line, sizeof line, "candidates   %llu of %llu computed again\n",
                number(v.checked.size()), number(v.candidates));
  text += line;
  std::snprintf(line, sizeof line,
                "worst        length %.1e mm, planarity %.1e mm, coincidence %.1e mm, diagonal "
                "%.1e mm, angle %.1e deg\n",
                v.worst.length_mm, v.worst.planarity_mm, v.worst.coincidence_mm, v.diagonal_mm,
                v.worst.angle_deg);
  text += line;
  if (const CheckedCandidate* first = v.first_contact()) {
    std::snprintf(line, sizeof line,
                  "contacts     panels cross in %llu of them, first at %g deg (draw %llu, %s)\n",
                  number(v.contacts()), *first->first_contact_deg, number(first->draw),
                  first->contact.c_str());
    text += line;
  } else {
    text += "contacts     none: no two panels without a common vertex cross\n";
  }
  return text + "findings     " + (v.good() ? "none" : std::to_string(v.findings.size())) + "\n";
}

Json verification_json(const Verification& v) {
  Json findings = Json::array(), checked = Json::array();
  for (const schema::Finding& finding : v.findings) {
    findings.push_back(finding.details);
    findings.back()["sentence"] = finding.sentence;
  }
  for (const CheckedCandidate& candidate : v.checked) {
    const bool crosses = candidate.first_contact_deg.has_value();
    checked.push_back({{"draw", candidate.draw},
                       {"first_contact_deg", crosses ? Json(*candidate.first_contact_deg) : Json()},
                       {"panels", crosses ? Json(candidate.contact) : Json()}});
  }
  return {{"campaign", v.campaign},
          {"digest", v.digest},
          {"candidates", v.candidates},
          {"checked", checked},
          {"good", v.good()},
          {"findings", findings},
          {"worst",
           {{"length_mm", v.worst.length_mm},
            {"planarity_mm", v.worst.planarity_mm},
            {"coincidence_mm", v.worst.coincidence_mm},
            {"diagonal_mm", v.diagonal_mm},
            {"angle_deg", v.worst.angle_deg}}}};
}

}  // namespace misalign::search
