#include "search/checks/verify.hpp"

#include <algorithm>
#include <random>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/certificate_table.hpp"
#include "search/checks/draws_again.hpp"
#include "search/checks/spread.hpp"
#include "search/sheets/on_threads.hpp"
#include "search/sheets/whole_program.hpp"
#include "search/terminal/long_work.hpp"
#include "search/terminal/usable_threads.hpp"

namespace misalign::search {
namespace {

using schema::Json;

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
  Verifier(SQLite::Database& database, const std::string& path, const schema::Campaign& campaign,
           const VerifyOptions& options, Verification& verification)
      : database_(database),
        path_(path),
        campaign_(campaign),
        options_(options),
        v_(verification) {}

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
    check_candidates();
    const CandidateCheck check(campaign_);
    // A sample of ends is checked with their units.
    if (campaign_.search.shape) fault_samples_.clear();
    for (const std::uint64_t draw : fault_samples_) {
      show_work("fault samples judged again", v_.fault_samples.checked, fault_samples_.size());
      for (const StoredVerdict& row : stored_verdicts(database_, {draw, draw + 1})) {
        compare_verdict(row, check, v_.findings);
        ++v_.fault_samples.checked;
      }
    }
    v_.memory = check_memory(database_, campaign_, path_, options_.sample, v_.findings);
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
  void check_candidates() {
    std::vector<CandidateReport> reports(candidates_.size());
    std::uint64_t done = 0;
    on_threads(
        static_cast<std::size_t>(usable_threads()), candidates_.size(),
        [&](std::size_t) {
          return [&, check = std::make_shared<CandidateCheck>(campaign_)](std::size_t k) {
            return report_on(candidates_[k], *check);
          };
        },
        [&](std::size_t k, const CandidateReport& report) {
          show_work("candidates computed again", ++done, candidates_.size());
          reports[k] = report;
          return true;
        });
    for (std::size_t k = 0; k < reports.size(); ++k) add(reports[k], candidates_[k]);
  }

  CandidateReport report_on(std::uint64_t draw, const CandidateCheck& check) {
    const Json row = schema::read_candidate(database_, draw);
    CandidateReport report = check.check(row, schema::metrics_version_of(database_, draw));
    if (campaign_.search.has_ends()) {
      check.check_ascent(row, schema::read_ascent(database_, draw), report);
    }
    return report;
  }

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
  const std::string& path_;
  const schema::Campaign& campaign_;
  const VerifyOptions& options_;
  Verification& v_;
  std::vector<std::uint64_t> candidates_, fault_samples_;
  std::vector<schema::DrawRange> units_;
  bool is_of_its_campaign_ = true;
};

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
    Verifier verifier(database, path, campaign, options, verification);
    verifier.look();
    moment.reset();  // otherwise a writer's log would grow
    verifier.compute();
  } catch (const schema::UserError& error) {               // the rest cannot be read
    if (error.cause() != schema::Cause::bad_input) throw;  // the disk's fault, not the file's
    verification.findings.push_back({error.what(), {{"where", "file"}}});
  }
  return verification;
}

}  // namespace misalign::search
