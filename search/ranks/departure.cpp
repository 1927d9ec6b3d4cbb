#include "search/ranks/departure.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <utility>

#include "search/ranks/stop_signal.hpp"

namespace misalign::search {
namespace {

enum class MainThread { at_work, may_be_left, left };
std::atomic<MainThread> main_thread = MainThread::at_work;

bool leave_main_thread() {
  MainThread before = MainThread::may_be_left;
  return main_thread.compare_exchange_strong(before, MainThread::left);
}

}  // namespace

MayBeLeft::MayBeLeft() { main_thread = MainThread::may_be_left; }

MayBeLeft::~MayBeLeft() {
  MainThread before = MainThread::may_be_left;
  main_thread.compare_exchange_strong(before, MainThread::at_work);
  while (before == MainThread::left) pause();  // until the process has ended
}

Departure::Departure(double patience_s, LeftFrom from, Leave leave)
    : patience_s_(patience_s),
      from_(from),
      leave_(std::move(leave)),
      thread_([this](const std::stop_token& stop) { wait(stop); }) {}

void Departure::wait(const std::stop_token& stop) {
  constexpr auto kLook = std::chrono::milliseconds(10);
  constexpr double kLastWord_s = 0.45;  // after the patience: before mpirun's second is over
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable_any never;
  while (!never.wait_for(lock, stop, kLook, [&] { return stop.stop_requested(); })) {
    const double since_s = seconds_since_leave();
    if (since_s < patience_s_) continue;
    if (from_ == LeftFrom::anywhere || leave_main_thread()) depart();
    if (since_s < patience_s_ + kLastWord_s || told_.exchange(true)) continue;
    spdlog::warn(
        "asked to stop while the catalogue is being written, which takes some time; if this is "
        "killed before its end, committed results are kept, and the same command resumes");
  }
}

void Departure::depart() const {
  const int exit_code = leave_();
  std::fflush(stdout);
  _exit(exit_code);
}

}  // namespace misalign::search
