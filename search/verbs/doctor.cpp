// `misalign doctor`: the checks of a machine, or of all that mpirun starts it on.
#include "search/checks/machine_check.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/draws/golden_verdicts.hpp"
#include "search/ranks/mpi_session.hpp"
#include "search/ranks/run_info.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct DoctorCall {
  std::string directory = ".";  // of catalogues
  bool json = false;
};

// Prints on rank 0; returns exit code 1 if anything is bad.
int run_doctor(const DoctorCall& call) {
  const MpiSession mpi(MpiSession::Alone::with_mpi);
  const auto set = solver::available_instruction_sets().back();
  const auto reports =
      mpi.gather(pack(RankReport{host_name(), usable_threads(), golden_verdicts(set)}));
  int exit_code = 0;
  if (mpi.rank() == 0) {
    std::vector<Check> checks = check_numbers();
    checks.push_back(check_libraries());
    std::vector<RankReport> ranks;
    for (const std::string& report : reports) ranks.push_back(unpack_rank(report));
    for (auto&& more : {check_ranks(ranks, mpi.has_beats()), check_directory(call.directory)}) {
      checks.insert(checks.end(), more.begin(), more.end());
    }
    call.json ? put_json(checks_json(checks)) : put(checks_text(checks));
    exit_code = any_bad(checks) ? exit_code_of(schema::Cause::failure) : 0;
  }
  return mpi.broadcast(exit_code);
}

}  // namespace

Action doctor_verb(CLI::App& verb) {
  verb.description("check whether this machine can run a campaign well");
  verb.footer(
      "Checks the random numbers, the verdicts of every instruction set on known sheets, MPI\n"
      "and its slots, and the directory for catalogues; lists the libraries of this build.\n"
      "Exit code 1 if a campaign would fail, or could not be trusted.\n\n"
      "Examples:\n  misalign doctor results\n  mpirun -n 8 --hostfile hosts misalign doctor");
  auto call = std::make_shared<DoctorCall>();
  verb.add_option("DIRECTORY", call->directory, "directory for catalogues [.]");
  verb.add_flag("--json", call->json, "as JSON");
  return [call] { return run_doctor(*call); };
}

}  // namespace misalign::search
