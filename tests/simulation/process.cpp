#include "tests/simulation/process.hpp"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

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
    life.is_visit ? disk.visit() : disk.begin_life(life.work, life.faults);
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
  end_ = {WIFSIGNALED(status),
          WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status),
          disk_.state().lost_power,
          disk_.state().calls,
          text_of(out_),
          text_of(err_)};
  return std::nullopt;
}

void stand_still(int visit) {
  char go_on;
  if (::write(tell, &visit, sizeof visit) != sizeof visit || ::read(hear, &go_on, 1) != 1) {
    ::syscall(SYS_exit_group, EXIT_FAILURE);
  }
}

LifeEnd run_through(Disk& disk, const Life& life) {
  Process process(disk, life);
  while (process.run_on()) continue;
  return process.end();
}

}  // namespace misalign::simulation
