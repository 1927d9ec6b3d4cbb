#include "search/ranks/stop_signal.hpp"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>

#include "schema/files/input.hpp"
#include "search/terminal/screen.hpp"

namespace misalign::search {
namespace {

using Nanoseconds = std::chrono::nanoseconds;

constexpr int kLeaveSignals[] = {SIGTERM, SIGINT, SIGHUP, SIGXCPU, SIGALRM};
constexpr Nanoseconds kSameRequest = std::chrono::milliseconds(500);

volatile std::sig_atomic_t drain_seen = 0, status_seen = 0;
std::atomic<Nanoseconds::rep> leave_since = 0;  // 0: no request
static_assert(std::atomic<Nanoseconds::rep>::is_always_lock_free);

Nanoseconds now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);  // a handler may call this
  return std::chrono::seconds(time.tv_sec) + Nanoseconds(time.tv_nsec);
}

extern "C" {

void note_drain(int) { drain_seen = 1; }
void note_status(int) { status_seen = 1; }

void note_leave(int signal) {
  static constexpr char kWhy[] =
      "misalign: asked twice to stop, this ends at once; committed results are kept, and the same "
      "command resumes\n";
  const Nanoseconds time = now();
  Nanoseconds::rep first = 0;
  if (leave_since.compare_exchange_strong(first, time.count())) return;
  // SIGXCPU is repeated every second.
  const bool is_insisting = signal == SIGTERM || signal == SIGINT;
  if (!is_insisting || time - Nanoseconds(first) < kSameRequest) return;
  leave_live_line();
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kWhy, sizeof kWhy - 1);
  _exit(128 + signal);
}

// Ends the process if another program truncates the index of SQLite's log, which is mapped. No
// write is lost: the next program that opens the catalogue rebuilds the index from the log.
void end_for_lost_page(int signal, siginfo_t* info, void*) {
  if (info->si_code != BUS_ADRERR) {  // an error of this program, or a signal of another one
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  static constexpr char kWhy[] =
      "misalign: a file in use was truncated (by another program, perhaps the -shm file beside the "
      "catalogue, or the disk is full); committed results are kept, and the same command resumes\n";
  leave_live_line();
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kWhy, sizeof kWhy - 1);
  _exit(EXIT_FAILURE);
}

}  // extern "C"

sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : kLeaveSignals) sigaddset(&set, signal);
  for (const int signal : {SIGUSR1, SIGUSR2}) sigaddset(&set, signal);
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

void watch_for_signals() {
  for (const int signal : kLeaveSignals) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    const bool is_asked = signal == SIGTERM || signal == SIGINT;  // a deliberate request
    if (is_asked || before.sa_handler != SIG_IGN) std::signal(signal, note_leave);
  }
  std::signal(SIGUSR1, note_drain);
  std::signal(SIGUSR2, note_status);
  const sigset_t watched = watched_signals();
  pthread_sigmask(SIG_UNBLOCK, &watched, nullptr);
}

StopRequest stop_request() {
  if (leave_since != 0) return StopRequest::leave;
  return drain_seen ? StopRequest::drain : StopRequest::none;
}

double seconds_since_leave() {
  const Nanoseconds::rep since = leave_since;
  return since == 0 ? -1 : std::chrono::duration<double>(now() - Nanoseconds(since)).count();
}

bool status_request() {
  if (!status_seen) return false;
  status_seen = 0;
  return true;
}

}  // namespace misalign::search
