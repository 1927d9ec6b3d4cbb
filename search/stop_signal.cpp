#include "search/stop_signal.hpp"

#include <csignal>
#include <initializer_list>

namespace misalign::search {
namespace {

volatile std::sig_atomic_t stop_seen = 0;

extern "C" void note_stop(int) { stop_seen = 1; }

}  // namespace

void watch_for_stop_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, note_stop);
}

bool stop_signal_seen() { return stop_seen != 0; }

}  // namespace misalign::search
