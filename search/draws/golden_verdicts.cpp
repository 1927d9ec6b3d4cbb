#include "search/draws/golden_verdicts.hpp"

#include "schema/campaign/campaign_file.hpp"
#include "schema/files/hash.hpp"
#include "search/draws/draw_evaluator.hpp"

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

}  // namespace misalign::search
