// Runs `search --ranks N`: starts mpirun, passes signals on, and ends as the search ends.
#pragma once

#include <string>
#include <vector>

namespace misalign::search {

/// Exit code of rank 0 when its time is over after SIGTERM or SIGINT and a starter waits for it:
/// mpirun counts a rank that exits with 0 as done, and the others would wait for it.
inline constexpr int kLeftWithStarter = 143;

/// Runs this program with the arguments `words` under mpirun, on this machine alone, and returns
/// its exit code: `stopped_exit` if a signal has ended it. SIGINT, SIGTERM, SIGHUP, SIGXCPU and
/// SIGALRM go to rank 0 as SIGTERM, SIGUSR1 and SIGUSR2 to all, SIGTSTP (Ctrl-Z) to nobody, and if
/// this process is killed, mpirun is asked to end.
/// @throws UserError  there is no mpirun, or it could start nothing
int run_under_mpirun(int ranks, const std::vector<std::string>& words, int stopped_exit);

/// Returns whether such a process waits for this one.
bool has_starter();
/// Tells that process which one rank 0 is. Signals must be watched before.
void tell_starter();

}  // namespace misalign::search
