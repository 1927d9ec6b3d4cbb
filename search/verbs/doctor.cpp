#include "search/verbs/doctor.hpp"

#include <cstdio>

#include "search/checks/machine_check.hpp"
#include "search/draws/trial.hpp"
#include "search/ranks/mpi_session.hpp"
#include "search/ranks/run_info.hpp"
#include "search/terminal/terminal.hpp"

namespace misalign::search {
int run_doctor(const std::string& directory, bool json) {
  const MpiSession mpi(MpiSession::Alone::with_mpi);
  const auto set = solver::available_instruction_sets().back();
  const auto reports =
      mpi.gather(pack(RankReport{host_name(), usable_threads(), golden_verdicts(set)}));
  int exit_code = 0;
  if (mpi.rank() == 0) {
    std::vector<Check> checks = check_numbers();
    std::vector<RankReport> ranks;
    for (const std::string& report : reports) ranks.push_back(unpack_rank(report));
    for (auto&& more : {check_ranks(ranks, mpi.has_beats()), check_directory(directory)}) {
      checks.insert(checks.end(), more.begin(), more.end());
    }
    json ? put_json(checks_json(checks)) : put(checks_text(checks));
    exit_code = any_bad(checks) ? schema::kExitFailure : 0;
  }
  return mpi.broadcast(exit_code);
}

}  // namespace misalign::search
