// A splitting search in a moment: a campaign, and its catalogue gone on with.
#pragma once

#include "schema/campaign/campaign_file.hpp"
#include "search/ranks/climb_task.hpp"
#include "tests/search/splitting_campaigns.hpp"

namespace misalign::search {

/// Short paths, nearly all of which deploy; levels at 20 and 27 degrees.
inline schema::Campaign quick_climb() {
  return schema::read_campaign(
      schema::Json::parse(
          R"({"name": "quick", "pattern": {"family": "miura", "rows": 4, "columns": 4},
              "path": {"end_deg": 30}, "accept": {"deploys_from_deg": 27},
              "search": {"method": "splitting", "levels_deg": [20, 27], "particles": 20,
                         "sweeps": 2, "first_draws": 60}})"),
      "a test");
}

/// As `misalign search` on one rank: so many populations are wanted, and at most so many blocks
/// done.
inline void climb_on(const std::string& path, Climber& climber, const schema::RunInfo& run,
                     std::uint64_t populations, int blocks) {
  schema::Catalogue catalogue(path, climber.campaign(), climber.mechanism());
  schema::Goal goal;
  goal.of_populations = true;
  goal.range = schema::numbers_of({0, populations});
  catalogue.begin_run(run, goal, schema::Builds::mixed);
  {
    ClimbTask task(climber, catalogue, goal, 1);
    while (blocks-- > 0 && task.compute_one_block()) task.commit();
    task.hand_in_own();
    task.commit_all();
  }
  catalogue.end_run("stopped");
}

}  // namespace misalign::search
