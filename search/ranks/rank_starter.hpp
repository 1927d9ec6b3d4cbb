// `search --ranks N`: this process starts mpirun, passes signals on, and ends as the search ends.
#pragma once

#include <string>
#include <vector>

namespace misalign::search {

/// What rank 0 leaves with when its time is up after a SIGTERM or SIGINT, if a starter waits for
/// it: mpirun takes 0 for a rank that is done, and the others would wait for it.
inline constexpr int kLeftWithStarter = 143;

/// Runs this program with these words under mpirun, on this machine alone, and returns its exit
/// code: `stopped_exit` where a signal has ended it. SIGINT, SIGTERM, SIGHUP, SIGXCPU and SIGALRM
/// go to rank 0 as SIGTERM, SIGUSR1 and SIGUSR2 to all, SIGTSTP (Ctrl-Z) to nobody, and if this
/// process is killed, mpirun is asked to end.
/// @throws UserError  there is no mpirun, or it could start nothing
int run_under_mpirun(int ranks, const std::vector<std::string>& words, int stopped_exit);

/// Whether a process as above waits for this one.
bool has_starter();
/// Rank 0 to that process: here I am. Signals must be watched by then.
void tell_starter();

}  // namespace misalign::search
