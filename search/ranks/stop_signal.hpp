// Signals that ask this rank to stop, or for a status line, or say that a file was cut short.
// Handlers only set flags, except for two last resorts.
#pragma once

namespace misalign::search {

enum class StopRequest {
  none,
  drain,  ///< SIGUSR1: cut the units under way short and commit all of them, however long it takes
  leave   ///< SIGTERM, SIGINT, SIGHUP, SIGXCPU, SIGALRM: the same without what takes too long
};

/// From now on a file that is cut short where it is mapped ends the process with a sentence and
/// EXIT_FAILURE. Before MPI begins, which would have a handler of its own.
void watch_for_lost_pages();

/// From now on the signals wait: Open MPI hangs when one of them interrupts or ends a rank that it
/// is starting.
void hold_signals();

/// From now on the signals mean this; SIGHUP, SIGXCPU and SIGALRM nothing where the parent ignores
/// them (nohup). A second SIGTERM or SIGINT ends the process at once, with a sentence; within half
/// a second it is the first one again, which mpirun and a batch system both pass on.
void watch_for_signals();

StopRequest stop_request();

/// Since the first request to leave; negative if there was none.
double seconds_since_leave();

/// Whether SIGUSR2 has asked for a status line since this was last called.
bool status_request();

}  // namespace misalign::search
