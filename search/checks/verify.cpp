#include "search/checks/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/certificate_table.hpp"
#include "schema/files/features.hpp"
#include "search/checks/draws_again.hpp"
#include "search/sheets/whole_program.hpp"
#include "search/terminal/count_text.hpp"
#include "search/terminal/long_work.hpp"

namespace misalign::search {
namespace {

using schema::Json;

// Returns `wanted` of all items, spread evenly.
template <class Item>
std::vector<Item> spread(const std::vector<Item>& all, std::optional<std::uint64_t> wanted) {
  const std::uint64_t chosen = std::min<std::uint64_t>(wanted.value_or(all.size()), all.size());
  std::vector<Item> some;
  for (std::uint64_t k = 0; k < chosen; ++k) some.push_back(all[k * all.size() / chosen]);
  return some;
}

// Returns `wanted` units with equal probability (selection sampling, Knuth's algorithm S).
std::vector<schema::DrawRange> at_random(const std::vector<schema::DrawRange>& all,
                                         std::uint64_t wanted, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<schema::DrawRange> some;
  for (std::uint64_t k = 0; k < all.size() && some.size() < wanted; ++k) {
    if (random() % (all.size() - k) < wanted - some.size()) some.push_back(all[k]);
  }
  return some;
}

class Verifier {
 public:
  Verifier(SQLite::Database& database, const schema::Campaign& campaign,
           const VerifyOptions& options, Verification& verification)
      : database_(database), campaign_(campaign), options_(options), v_(verification) {}

  // Checks the ledger and chooses rows, within one moment.
  void look() {
    schema::CheckedLedger checked = schema::read_checked(database_, campaign_);
    v_.findings = std::move(checked.findings);
    if (!checked.state) throw schema::UserError(schema::Cause::bad_input, checked.why_no_state);
    v_.digest = checked.state->digest;
    constexpr schema::DrawRange kAll{0, schema::kEndOfDraws};
    const auto draws = schema::draws_of(database_, "candidate", kAll);
    v_.candidates = draws.size();
    candidates_ = spread(draws, options_.sample);
    const auto sampled = schema::draws_of(database_, "fault_sample", kAll);
    v_.fault_samples.of = sampled.size();
    fault_samples_ = spread(sampled, options_.sample);
    const auto units = schema::units_done(database_);
    v_.units.of = units.size();
    const auto certificates = schema::check_certificates(database_, campaign_);
    v_.certificates = {certificates.count - certificates.findings.size(), certificates.count};
    v_.findings.insert(v_.findings.end(), certificates.findings.begin(),
                       certificates.findings.end());
    units_ = at_random(units, options_.units, options_.seed);
    is_of_its_campaign_ = checked.state->identity == schema::identity(campaign_);
  }

  // Computes the chosen rows again, unless they are of another campaign, which is a finding
  // already.
  void compute() {
    if (!is_of_its_campaign_) return;
    const CandidateCheck check(campaign_);
    for (const std::uint64_t draw : candidates_) {
      show_work("candidates computed again", v_.checked.size(), candidates_.size());
      const Json row = schema::read_candidate(database_, draw);
      CandidateReport report = check.check(row, schema::metrics_version_of(database_, draw));
      if (campaign_.search.has_ends()) {
        check.check_ascent(row, schema::read_ascent(database_, draw), report);
      }
      add(report, draw);
    }
    // A sample of ends is checked with their units.
    if (campaign_.search.shape) fault_samples_.clear();
    for (const std::uint64_t draw : fault_samples_) {
      show_work("fault samples judged again", v_.fault_samples.checked, fault_samples_.size());
      for (const StoredVerdict& row : stored_verdicts(database_, {draw, draw + 1})) {
        compare_verdict(row, check, v_.findings);
        ++v_.fault_samples.checked;
      }
    }
    if (units_.empty()) return;
    const solver::InstructionSet widest = solver::available_instruction_sets().back();
    if (campaign_.search.splitting) {
      Climber climber(campaign_, widest, kWithoutProofs);
      for (const schema::DrawRange& unit : units_) {
        show_work("populations made again", v_.units.checked, units_.size());
        make_population_again(database_, climber, unit.lo, v_.findings);
        ++v_.units.checked;
        ++v_.draws_again;
      }
      return;
    }
    DrawEvaluator evaluator(campaign_, widest, kWithoutProofs);
    for (const schema::DrawRange& unit : units_) {
      show_work("units made again", v_.units.checked, units_.size());
      v_.decided_now += make_unit_again(database_, evaluator, unit, v_.findings);
      ++v_.units.checked;
      v_.draws_again += unit.size();
    }
  }

 private:
  void add(const CandidateReport& report, std::uint64_t draw) {
    v_.checked.push_back({draw, report.first_contact_deg, report.contact, report.meet,
                          report.met_until_deg, report.meet_text});
    v_.findings.insert(v_.findings.end(), report.findings.begin(), report.findings.end());
    v_.not_comparable += !report.not_comparable.empty();
    v_.other_definitions.insert(report.not_comparable.begin(), report.not_comparable.end());
    const auto raise = [](double& worst, double value) { worst = std::max(worst, value); };
    raise(v_.worst.length_mm, report.shape.length_mm);
    raise(v_.worst.planarity_mm, report.shape.planarity_mm);
    raise(v_.worst.coincidence_mm, report.shape.coincidence_mm);
    raise(v_.worst.angle_deg, report.shape.angle_deg);
    raise(v_.diagonal_mm, report.diagonal_mm);
  }

  SQLite::Database& database_;
  const schema::Campaign& campaign_;
  const VerifyOptions& options_;
  Verification& v_;
  std::vector<std::uint64_t> candidates_, fault_samples_;
  std::vector<schema::DrawRange> units_;
  bool is_of_its_campaign_ = true;
};

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

std::string other_definitions_text(const Verification& v) {
  if (v.not_comparable == 0) return "";
  return fmt::format(
      "not compared {} of {} candidates: an older build measured them by another definition (no "
      "fault)\n",
      fmt::join(v.other_definitions, ", "), v.not_comparable);
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

const CheckedCandidate* Verification::first_meeting() const {
  const CheckedCandidate* first = nullptr;
  for (const CheckedCandidate& candidate : checked) {
    if (candidate.meet.is_null()) continue;
    if (!first || candidate.meet["pilot_deg"] < first->meet["pilot_deg"]) first = &candidate;
  }
  return first;
}

double Verification::chance_to_find_one() const {
  return units.of == 0 ? 0 : static_cast<double>(units.checked) / static_cast<double>(units.of);
}

Verification verify(SQLite::Database& database, const std::string& path,
                    const VerifyOptions& options) {
  Verification verification;
  verification.seed = options.seed;
  std::optional<SQLite::Transaction> moment;
  schema::reading(database, [&] { moment.emplace(database); });
  const schema::Campaign campaign = schema::read_campaign_of(database, path);
  verification.campaign = campaign.name;
  try {
    Verifier verifier(database, campaign, options, verification);
    verifier.look();
    moment.reset();  // otherwise a writer's log would grow
    verifier.compute();
  } catch (const schema::UserError& error) {               // the rest cannot be read
    if (error.cause() != schema::Cause::bad_input) throw;  // the disk's fault, not the file's
    verification.findings.push_back({error.what(), {{"where", "file"}}});
  }
  return verification;
}

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
  text += units_text(v) + other_definitions_text(v);
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
