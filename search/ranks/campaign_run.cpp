#include "search/ranks/campaign_run.hpp"

#include <fmt/format.h>

#include <set>

namespace misalign::search {

void expect_one_layout(const std::vector<RankInfo>& ranks) {
  for (std::size_t k = 0; k < ranks.size(); ++k) {
    if (ranks[k].layout == ranks[0].layout) continue;
    throw schema::UserError(
        schema::Cause::foreign,
        fmt::format("rank {} on {} sends its results in another layout than rank 0 on {} (it is "
                    "another build); install the same build on every host",
                    k, ranks[k].host, ranks[0].host));
  }
}

void say_nothing_began() {
  spdlog::warn("stopped before any work was done; the same command starts again");
}

void expect_joined(const MpiSession& mpi) {
  const auto tasks = launched_tasks();
  if (!tasks || mpi.ranks() > 1 || tasks->count <= 1) return;
  throw schema::UserError(
      schema::Cause::bad_request,
      fmt::format(
          "{0} has started {1} tasks ({2}), but MPI counts 1 rank in each (it cannot see the "
          "others: no PMIx), so that all would make the same draws; start them with the mpirun of "
          "its MPI, or with srun --mpi=pmix if that MPI has PMIx, or give each task its own draws "
          "with {3}, or use {4} if every task has its own catalogue",
          tasks->launcher, tasks->count, tasks->variable, schema::parameter("range"),
          schema::parameter("ranks", "1")));
}

std::vector<RankInfo> gather_ranks(const MpiSession& mpi, const RankInfo& info) {
  std::vector<RankInfo> ranks;
  const auto hosts = mpi.gather(info.host), layouts = mpi.gather(info.layout),
             verdicts = mpi.gather(info.golden_verdicts);
  for (std::size_t k = 0; k < hosts.size(); ++k) {
    ranks.push_back({hosts[k], layouts[k], verdicts[k]});
  }
  expect_one_layout(ranks);
  return ranks;
}

std::string common_verdicts(const std::vector<RankInfo>& ranks, schema::Builds builds) {
  std::set<std::string> different;
  for (std::size_t k = 0; k < ranks.size(); ++k) {
    different.insert(ranks[k].golden_verdicts);
    if (different.size() == 1 || builds == schema::Builds::mixed) continue;
    throw schema::UserError(
        schema::Cause::foreign,
        fmt::format("rank {} on {} gives other verdicts on the golden draws than rank 0 on {} "
                    "(it is another build, or its machine is broken); install the same build on "
                    "every host, or use {} if you know that the difference is harmless",
                    k, ranks[k].host, ranks[0].host, schema::parameter("allow_mixed_builds")));
  }
  return fmt::to_string(fmt::join(different, " "));
}

}  // namespace misalign::search
