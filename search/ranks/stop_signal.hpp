// Handles signals that request a stop or a status line, or report a truncated file. Handlers only
// set flags, except for two last resorts.
#pragma once

namespace misalign::search {

enum class StopRequest {
  none,
  drain,  ///< SIGUSR1: end units under way early and commit all of them, however long it takes
  leave   ///< SIGTERM, SIGINT, SIGHUP, SIGXCPU, SIGALRM: the same without units that take too long
};

/// Makes the truncation of a mapped file end the process with a sentence and EXIT_FAILURE. Call it
/// before MPI_Init, which would install its own handler.
void watch_for_lost_pages();

/// Blocks the signals: Open MPI hangs if one interrupts or ends a rank that it is starting.
void hold_signals();

/// Installs the handlers; SIGHUP, SIGXCPU and SIGALRM stay ignored if the parent ignores them
/// (nohup). A second SIGTERM or SIGINT ends the process at once with a sentence. Within half a
/// second it counts as the first, which mpirun and a batch system both pass on.
void watch_for_signals();

StopRequest stop_request();

/// Returns the time since the first request to leave; negative without one.
double seconds_since_leave();

/// Returns whether SIGUSR2 has requested a status line since the last call.
bool status_request();

}  // namespace misalign::search
