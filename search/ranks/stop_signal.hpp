// Signals that ask this rank to stop, or for a status line, or say that a file was cut short.
// Handlers only set flags, except for three last resorts.
#pragma once

namespace misalign::search {

enum class StopRequest {
  none,
  drain,  ///< SIGUSR1: cut the units under way short and commit all of them, however long it takes
  leave   ///< SIGTERM, SIGINT: the same in kLeave_s, then without what is not there yet
};

/// How long rank 0 may take to leave: mpirun kills its ranks a second after it was asked to stop.
/// The others leave when rank 0 lets them go, or soon after if it does not.
inline constexpr double kLeave_s = 0.4, kRelease_s = 3;

/// From now on a file that is cut short where it is mapped ends the process with a sentence and
/// EXIT_FAILURE. Before MPI begins, which would have a handler of its own.
void watch_for_lost_pages();

/// From now on the signals wait: Open MPI hangs when one of them interrupts or ends a rank that it
/// is starting.
void hold_signals();

/// From now on the signals mean this. A second SIGTERM or SIGINT ends the process at once; whatever
/// is left `leave_s` after the first is ended too, with `leave_code`.
void watch_for_signals(double leave_s, int leave_code);

StopRequest stop_request();

/// Whether SIGUSR2 has asked for a status line since this was last called.
bool status_request();

}  // namespace misalign::search
