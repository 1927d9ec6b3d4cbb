#include "search/ranks/stop_signal.hpp"

#include <pthread.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <ctime>
#include <initializer_list>

#include "schema/files/input.hpp"
#include "search/terminal/progress.hpp"

namespace misalign::search {
namespace {

volatile std::sig_atomic_t drain_seen = 0, leave_seen = 0, status_seen = 0;
timer_t leave_timer;
itimerspec leave_after{};
int leave_code = 0;

extern "C" {

void note_drain(int) { drain_seen = 1; }
void note_status(int) { status_seen = 1; }
void end_here(int) {
  leave_live_line();
  _exit(leave_code);
}

void note_leave(int signal) {
  if (leave_seen) {
    leave_live_line();
    _exit(128 + signal);
  }
  leave_seen = 1;
  timer_settime(leave_timer, 0, &leave_after, nullptr);
}

// SQLite maps the index of its log, which another program may cut short. Nothing is half-written
// by that: whoever opens the catalogue next makes the index anew from the log.
void end_for_lost_page(int signal, siginfo_t* info, void*) {
  if (info->si_code != BUS_ADRERR) {  // an error of this program, or sent by another one
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  static constexpr char kWhy[] =
      "misalign: a file that was in use lost a part (another program cut it short, perhaps the "
      "-shm file beside the catalogue, or there is no room for it); what was committed is good, "
      "and the same command goes on from there\n";
  leave_live_line();
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kWhy, sizeof kWhy - 1);
  _exit(EXIT_FAILURE);
}

}  // extern "C"

sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGTERM, SIGINT, SIGUSR1, SIGUSR2}) sigaddset(&set, signal);
  return set;
}

}  // namespace

void watch_for_lost_pages() {
  struct sigaction lost_page {};
  lost_page.sa_sigaction = end_for_lost_page;
  lost_page.sa_flags = SA_SIGINFO;
  sigaction(SIGBUS, &lost_page, nullptr);
}

void hold_signals() {
  const sigset_t watched = watched_signals();
  pthread_sigmask(SIG_BLOCK, &watched, nullptr);
}

void watch_for_signals(double leave_s, int code) {
  leave_code = code;
  double whole_s = 0;
  const double part_s = std::modf(leave_s, &whole_s);
  leave_after.it_value = {static_cast<time_t>(whole_s), static_cast<long>(part_s * 1e9)};
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGALRM;
  timer_create(CLOCK_MONOTONIC, &event, &leave_timer);
  std::signal(SIGALRM, end_here);
  std::signal(SIGTERM, note_leave);
  std::signal(SIGINT, note_leave);
  std::signal(SIGUSR1, note_drain);
  std::signal(SIGUSR2, note_status);
  const sigset_t watched = watched_signals();
  pthread_sigmask(SIG_UNBLOCK, &watched, nullptr);
}

StopRequest stop_request() {
  if (leave_seen) return StopRequest::leave;
  return drain_seen ? StopRequest::drain : StopRequest::none;
}

bool status_request() {
  if (!status_seen) return false;
  status_seen = 0;
  return true;
}

}  // namespace misalign::search
