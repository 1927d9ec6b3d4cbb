// reference_verdicts CAMPAIGN FIRST COUNT [STEP_DEG]: what the frozen reference says of these
// draws, a line for each: D in samples, first fault, crease or diagonal. With STEP_DEG as a
// careful run says it.
#include <cstdio>
#include <cstdlib>

#include "schema/campaign/campaign_file.hpp"
#include "search/verbs/reference_run.hpp"

using namespace misalign;

int main(int count, char** arguments) {
  if (count < 4) return 2;
  const schema::Campaign campaign = schema::read_campaign_file(arguments[1]);
  const solver::PerforatedSheet& base = campaign.pattern.base;
  const solver::Mechanism mechanism = solver::build_mechanism(base);
  search::ReferenceRun reference(campaign, mechanism);
  const std::uint64_t first = std::strtoull(arguments[2], nullptr, 10);
  for (std::uint64_t draw = first; draw < first + std::strtoull(arguments[3], nullptr, 10);
       ++draw) {
    const solver::Verdict verdict =
        count > 4 ? search::judge_carefully(campaign, mechanism, std::atof(arguments[4]), draw)
                  : reference.judge(draw);
    std::printf("%d %s %d\n", verdict.deploys_from_sample, solver::fault_name(verdict.first_fault),
                verdict.where);
  }
}
