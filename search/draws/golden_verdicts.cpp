#include "search/draws/golden_verdicts.hpp"

#include "schema/campaign/campaign_file.hpp"
#include "schema/files/hash.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "solver/studies/goal.hpp"

namespace misalign::search {

std::string golden_verdicts(solver::InstructionSet set) {
  DrawEvaluator evaluator(
      schema::read_campaign({{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                             {"accept", {{"deploys_from_deg", 180}}}},
                            "the golden campaign"),
      set);
  std::string whole_numbers;
  for (const solver::Verdict& verdict : evaluator.judge({0, 32})) {
    whole_numbers += std::to_string(verdict.deploys_from_sample) +
                     solver::fault_name(verdict.first_fault) + std::to_string(verdict.where) + " ";
  }
  return schema::hex(schema::hash_of(whole_numbers));
}

std::string fingerprint(const schema::Campaign& campaign, const std::string& golden_verdicts,
                        const Parts& parts) {
  if (!campaign.search.has_ends()) return golden_verdicts;
  std::string ends;  // of a small sheet's first draws, for each objective
  const auto add_ends = [&](const schema::Json& beside) {
    schema::Json golden = {{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                           {"accept", {{"deploys_from_deg", 150}}}};
    golden.update(beside);
    DrawEvaluator evaluator(schema::read_campaign(golden, "the golden campaign"),
                            solver::available_instruction_sets().back(), parts);
    for (const schema::Candidate& end : work_off(evaluator, {0, 4}).candidates) {
      ends += schema::displacements_json(end.shifts_mm).dump();
    }
  };
  if (campaign.search.shape) {
    add_ends({{"accept", {{"deploys_from_deg", 100}}},
              {"misalignment", {{"vertices", "all"}}},
              {"search", {{"method", "shape"}}},
              {"target", {{"surface", "sphere"}, {"radius_mm", 1440}}}});
  } else {
    for (const std::string& goal : solver::goal_names(&solver::Goal::is_same_everywhere)) {
      add_ends({{"search", {{"method", "optimise"}, {"maximise", goal}, {"from_deg", 36}}}});
    }
  }
  return golden_verdicts + "-" + schema::hex(schema::hash_of(ends));
}

}  // namespace misalign::search
