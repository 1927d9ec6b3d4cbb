// SIGINT, SIGTERM and SIGUSR1 ask the program to stop; the handler only sets a flag.
#pragma once

namespace misalign::search {

void watch_for_stop_signals();
bool stop_signal_seen();

}  // namespace misalign::search
