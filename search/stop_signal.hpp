// What signals ask of this rank. The handlers only set flags, but for two last resorts.
#pragma once

namespace misalign::search {

enum class StopWish {
  none,
  drain,  ///< SIGUSR1: cut the units under way short and commit all of them, however long it takes
  leave   ///< SIGTERM, SIGINT: the same within kLeave_s, then without what is not there yet
};

/// mpirun kills its ranks a second after it was asked to stop.
inline constexpr double kLeave_s = 0.4;

/// From now on the signals mean this. A second SIGTERM or SIGINT ends the process at once; whatever
/// is left kLeave_s after the first is ended too, with exit code 0.
void watch_for_signals();

StopWish stop_wish();

/// Whether SIGUSR2 has asked for a status line since this was last called.
bool status_wish();

}  // namespace misalign::search
