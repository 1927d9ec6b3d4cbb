#include "tests/simulation/process.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace misalign::simulation {
namespace {

int tell = -1, hear = -1;  // a process's ends of the pipes to its caller

std::string text_of(int file) {
  std::string text(static_cast<std::size_t>(::lseek(file, 0, SEEK_END)), ' ');
  if (::pread(file, text.data(), text.size(), 0) < 0) std::abort();
  return text;
}

}  // namespace

bool LifeEnd::was_killed() const { return by_signal && code == SIGKILL; }

Process::Process(Disk& disk, const Life& life) : disk_(disk) {
  int from[2], to[2];
  out_ = ::memfd_create("out", MFD_CLOEXEC);
  err_ = ::memfd_create("err", MFD_CLOEXEC);
  if (::pipe(from) != 0 || ::pipe(to) != 0 || out_ < 0 || err_ < 0) std::abort();
  std::fflush(nullptr);  // or a child would print it again
  id_ = ::fork();
  if (id_ < 0) std::abort();
  if (id_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::close(from[0]);
    ::close(to[1]);
    tell = from[1];
    hear = to[0];
    ::dup2(out_, STDOUT_FILENO);
    ::dup2(err_, STDERR_FILENO);
    if (::chdir(disk.folder().c_str()) != 0) std::abort();
    life.is_visit ? disk.visit() : disk.begin_life(static_cast<int>(life.work), life.faults);
    const auto note = [&](Nanoseconds DiskState::*time) -> std::function<void(Nanoseconds)> {
      return [&disk, time, counts = !life.is_visit](Nanoseconds now) {
        if (counts && disk.state().*time < 0) disk.state().*time = now;
      };
    };
    run_job({life.ranks, life.seed, life.program, life.happenings, stand_still,
             note(&DiskState::asked_at), note(&DiskState::ended_at)});
  }
  ::close(from[1]);
  ::close(to[0]);
  from_ = from[0];
  to_ = to[1];
}

Process::~Process() {
  if (id_ > 0) {
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
  }
  for (const int file : {from_, to_, out_, err_}) ::close(file);
}

std::optional<int> Process::run_on() {
  if (id_ == 0) return std::nullopt;
  constexpr char kGoOn = '.';
  if (stands_still_ && ::write(to_, &kGoOn, 1) != 1) std::abort();
  int visit = 0;
  stands_still_ = ::read(from_, &visit, sizeof visit) == sizeof visit;
  if (stands_still_) return visit;
  int status = 0;
  ::waitpid(id_, &status, 0);
  id_ = 0;
  const DiskState& state = disk_.state();
  end_.by_signal = WIFSIGNALED(status);
  end_.code = end_.by_signal ? WTERMSIG(status) : WEXITSTATUS(status);
  end_.lost_power = state.lost_power;
  end_.was_cut = state.has_ended;
  end_.calls = state.calls;
  end_.errors = state.errors;
  end_.draws_made = state.draws_made;
  if (state.asked_at >= 0) {
    end_.stop_s = static_cast<double>(state.ended_at - state.asked_at) / kSecond;
  }
  end_.out = text_of(out_);
  end_.err = text_of(err_);
  return std::nullopt;
}

void stand_still(int visit) {
  char go_on;
  if (::write(tell, &visit, sizeof visit) != sizeof visit || ::read(hear, &go_on, 1) != 1) {
    ::syscall(SYS_exit_group, EXIT_FAILURE);
  }
}

Life visit(std::function<int(int)> program) {
  Life life{std::move(program)};
  life.is_visit = true;
  return life;
}

std::string told_life(const Life& life, const LifeEnd& end) {
  std::string text =
      fmt::format("  {}: {} ranks", kWorkNames[static_cast<int>(life.work)], life.ranks);
  for (const Fault& fault : life.faults) {
    text += fmt::format(", {} at call {} for {}{}", kFaultNames[static_cast<int>(fault.kind)],
                        fault.at, fault.lasts, fault.after_call ? " after it" : "");
  }
  for (const Happening& happening : life.happenings) {
    text +=
        fmt::format(", {} {} at {:.3f} s", std::array{"signal", "silence", "visit"}[happening.kind],
                    happening.number, static_cast<double>(happening.at) / kSecond);
  }
  return text + fmt::format("; {} {} after {} calls{}\n{}{}", end.by_signal ? "signal" : "exit",
                            end.code, end.calls, end.lost_power ? ", power cut" : "", end.err,
                            end.out);
}

LifeEnd run_through(Disk& disk, const Life& life) {
  Process process(disk, life);
  while (process.run_on()) continue;
  return process.end();
}

}  // namespace misalign::simulation
