#include "search/ranks/campaign_run.hpp"

#include <fmt/format.h>

namespace misalign::search {

void expect_one_layout(const std::vector<RankInfo>& ranks) {
  for (std::size_t k = 0; k < ranks.size(); ++k) {
    if (ranks[k].layout == ranks[0].layout) continue;
    throw schema::UserError(
        schema::Cause::foreign,
        fmt::format("rank {} on {} sends its results in another layout than rank 0 on {} (another "
                    "build); put the same program on every host",
                    k, ranks[k].host, ranks[0].host));
  }
}

std::vector<RankInfo> gather_ranks(const MpiSession& mpi, const RankInfo& own) {
  std::vector<RankInfo> ranks;
  const auto hosts = mpi.gather(own.host), layouts = mpi.gather(own.layout),
             verdicts = mpi.gather(own.golden_verdicts);
  for (std::size_t k = 0; k < hosts.size(); ++k) {
    ranks.push_back({hosts[k], layouts[k], verdicts[k]});
  }
  expect_one_layout(ranks);
  return ranks;
}

}  // namespace misalign::search
