#include "schema/campaign/parallel_check.hpp"

#include "schema/pattern/perforation_check.hpp"

namespace misalign::schema {

bool closes_at_180(const Campaign& campaign) {
  return campaign.misalignment.parallel && !is_overconstrained(campaign.pattern.base);
}

void check_parallel(const Campaign& campaign, InputFaults& faults) {
  if (!campaign.misalignment.parallel) return;
  if (campaign.search.splitting) {
    const bool is_of_starts = campaign.search.optimisation.has_value();
    faults.add(is_of_starts ? "search.starts = \"splitting\"" : "search.method = \"splitting\"",
               "changes vertices one by one, and members of the parallel family change together",
               std::string("write \"") + (is_of_starts ? "draws" : "plain") +
                   "\"; most members with like signs are accepted");
  }
  if (closes_at_180(campaign) && campaign.end_deg > 180 - campaign.sample_deg) {
    faults.add("path.end_deg = " + shown_number(campaign.end_deg),
               "all creases of a member close at 180 degrees, where rounding would decide",
               "try " + shown_number(180 - campaign.sample_deg) + ", the default of such draws");
  }
}

}  // namespace misalign::schema
