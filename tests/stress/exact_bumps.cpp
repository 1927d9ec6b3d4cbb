// Compares what false, true and "exact" of accept.between_samples make of the same draws, and what
// is true where the last two differ: solves in steps of 0.01 degrees say so.
//   exact_bumps DRAWS CAMPAIGN...
#include <fmt/format.h>

#include "../solver/finely_judged.hpp"
#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw_evaluator.hpp"

namespace misalign {
namespace {

constexpr double kFineStep_deg = 0.01;
constexpr int kListed = 5;

bool same(const solver::Verdict& a, const solver::Verdict& b) {
  return a.deploys_from_sample == b.deploys_from_sample && a.first_fault == b.first_fault &&
         a.where == b.where;
}

std::vector<solver::Verdict> judged(search::DrawEvaluator& evaluator, std::uint64_t draws) {
  std::vector<solver::Verdict> verdicts;
  for (std::uint64_t lo = 0; lo < draws; lo += evaluator.largest_block()) {
    const auto& block = evaluator.judge({lo, std::min(draws, lo + evaluator.largest_block())});
    verdicts.insert(verdicts.end(), block.begin(), block.end());
  }
  return verdicts;
}

// Whether a search finds the candidates that the verdicts say.
bool finds_the_same(search::DrawEvaluator& evaluator,
                    const std::vector<solver::Verdict>& verdicts) {
  const schema::UnitRecord unit = search::work_off(evaluator, {0, verdicts.size()});
  std::size_t next = 0;
  for (std::uint64_t draw = 0; draw < verdicts.size(); ++draw) {
    if (!evaluator.campaign().accepts(verdicts[draw])) continue;
    if (next == unit.candidates.size() || unit.candidates[next].draw != draw ||
        std::abs(unit.candidates[next].metrics.deploys_from_deg -
                 verdicts[draw].deploys_from_sample * evaluator.campaign().sample_deg) > 1e-9) {
      return false;
    }
    ++next;
  }
  return next == unit.candidates.size();
}

struct Counts {
  int accepted[3] = {}, differ = 0, differ_in_acceptance = 0, undecided = 0;
  int exact_is_fine = 0, cubic_is_fine = 0, neither = 0, near_band = 0;
};

// True if nothing spoke against "exact".
bool compare(schema::Campaign campaign, std::uint64_t draws) {
  std::vector<solver::Verdict> verdicts[3];
  Counts counts;
  bool found = false;
  for (int rule = 0; rule < 3; ++rule) {
    campaign.between_samples = static_cast<solver::BumpRule>(rule);
    search::DrawEvaluator evaluator(campaign);
    verdicts[rule] = judged(evaluator, draws);
    for (const solver::Verdict& verdict : verdicts[rule]) {
      counts.accepted[rule] += campaign.accepts(verdict);
      counts.undecided += verdict.first_fault == solver::Fault::undecided;
    }
    if (rule == 2) found = finds_the_same(evaluator, verdicts[2]);
  }
  const search::DrawEvaluator shifts(campaign);
  const solver::PerforatedSheet& base = campaign.pattern.base;
  std::string list;
  for (std::uint64_t draw = 0; draw < draws; ++draw) {
    const solver::Verdict &cubic = verdicts[1][draw], &exact = verdicts[2][draw];
    if (same(cubic, exact)) continue;
    ++counts.differ;
    counts.differ_in_acceptance += campaign.accepts(cubic) != campaign.accepts(exact);
    const solver::FineVerdict fine = solver::judge_finely(
        base, campaign.path(), kFineStep_deg, base.sheet.vertices_mm + shifts.shifts_mm(draw));
    const bool exact_is_fine = same(fine.exact(), exact), cubic_is_fine = same(fine.exact(), cubic);
    counts.exact_is_fine += exact_is_fine;
    counts.cubic_is_fine += cubic_is_fine;
    counts.neither += !exact_is_fine && !cubic_is_fine;
    counts.near_band += fine.nearest < 1e-11;
    if (counts.differ > kListed && exact_is_fine) continue;
    list += fmt::format("  draw {}: true {} {} {}, exact {} {} {}, fine {} {} {} (back {:.1e})\n",
                        draw, cubic.deploys_from_sample, fault_name(cubic.first_fault), cubic.where,
                        exact.deploys_from_sample, fault_name(exact.first_fault), exact.where,
                        fine.exact().deploys_from_sample, fault_name(fine.exact().first_fault),
                        fine.exact().where, fine.bump_back);
  }
  fmt::print(
      "{:<24} {} draws: accepted {} (false), {} (true), {} (exact), undecided {}; verdicts of true "
      "and exact differ {}, acceptance {}; solves every {} deg: exact {}, true {}, neither {}, "
      "within 1e-11 of the band {}; a search {}\n{}",
      campaign.name, draws, counts.accepted[0], counts.accepted[1], counts.accepted[2],
      counts.undecided, counts.differ, counts.differ_in_acceptance, kFineStep_deg,
      counts.exact_is_fine, counts.cubic_is_fine, counts.neither, counts.near_band,
      found ? "finds the same" : "FINDS OTHERS", list);
  std::fflush(stdout);
  return found && counts.exact_is_fine + counts.near_band >= counts.differ;
}

}  // namespace
}  // namespace misalign

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "exact_bumps DRAWS CAMPAIGN...\n");
    return 2;
  }
  bool good = true;
  for (int k = 2; k < argc; ++k) {
    good = misalign::compare(misalign::schema::read_campaign_file(argv[k]), std::stoull(argv[1])) &&
           good;
  }
  return good ? 0 : 1;
}
