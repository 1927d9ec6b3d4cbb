#include "search/terminal/long_work.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <system_error>
#include <utility>

#include "search/terminal/duration.hpp"
#include "search/terminal/screen.hpp"

namespace misalign::search {
namespace {

constexpr double kFirst_s = 5, kBetweenLines_s = 30, kBetweenRedrawings_s = 0.5;

LongWork* living = nullptr;

}  // namespace

std::string work_line(const WorkState& state) {
  std::string line = duration(state.elapsed_s) + ": ";
  if (state.done > 0 || state.all > 0) line += std::to_string(state.done) + " ";
  if (state.all > 0) line += fmt::format("of {} ", state.all);
  line += state.what;
  if (state.done > 0 && state.all > state.done) {
    const auto left = static_cast<double>(state.all - state.done);
    line += fmt::format(", {} left",
                        duration(state.what_elapsed_s * left / static_cast<double>(state.done)));
  }
  return line;
}

LongWork::LongWork(std::string name, ProgressStyle style, bool all)
    : style_(style), all_(all && style != ProgressStyle::none) {
  state_.what = std::move(name);
  living = this;
  if (style_ == ProgressStyle::none) return;
  // The working threads alone receive signals.
  sigset_t every, before;
  sigfillset(&every);
  pthread_sigmask(SIG_SETMASK, &every, &before);
  try {
    thread_ = std::thread([this] { watch(); });
  } catch (const std::system_error&) {
    // No thread is available: the work continues without progress lines.
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

LongWork::~LongWork() {
  if (all_ && !has_ended_ && state_.done > 0) print();
  end();
  living = nullptr;
}

void LongWork::see(const std::string& what, std::uint64_t done, std::uint64_t all) {
  const std::lock_guard lock(mutex_);
  const bool is_new = what != state_.what && done + all > 0;
  if (is_new && all_ && state_.done > 0) print();
  if (is_new) what_begun_s_ = watch_.seconds();
  state_.what = what;
  state_.done = done;
  state_.all = all;
  if (is_new && all_) print();
}

void LongWork::end() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(has_ended_, true)) return;
  }
  ends_.notify_all();
  if (thread_.joinable()) thread_.join();
  erase_live_line();
}

void LongWork::watch() {
  const double every_s = style_ == ProgressStyle::bar ? kBetweenRedrawings_s : kBetweenLines_s;
  std::unique_lock lock(mutex_);
  for (double next_s = kFirst_s; !has_ended_; next_s = watch_.seconds() + every_s) {
    const std::chrono::duration<double> rest(next_s - watch_.seconds());
    if (ends_.wait_for(lock, rest, [this] { return has_ended_; })) return;
    print();
  }
}

// Requires the lock, unless no other thread runs.
void LongWork::print() {
  state_.elapsed_s = watch_.seconds();
  state_.what_elapsed_s = state_.elapsed_s - what_begun_s_;
  const std::string line = work_line(state_);
  if (style_ == ProgressStyle::bar) {
    const int room = std::max(terminal_width(STDERR_FILENO) - 1, 0);
    draw_live_line(line.substr(0, static_cast<std::size_t>(room)));
  } else {
    std::fprintf(stderr, "%s\n", line.c_str());
  }
}

ProgressStyle work_style(bool under_launcher) {
  if (!spdlog::should_log(spdlog::level::info)) return ProgressStyle::none;
  return resolved(ProgressStyle::automatic, is_terminal(STDERR_FILENO) && terminal_is_able(),
                  under_launcher);
}

void show_work(const std::string& what, std::uint64_t done, std::uint64_t all) {
  if (living) living->see(what, done, all);
}

void end_shown_work() {
  if (living) living->end();
}

}  // namespace misalign::search
