#include "search/terminal/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "schema/files/input.hpp"

namespace misalign::search {
namespace {

// Execs the program in the child process; sends errno if that fails.
[[noreturn]] void become(const std::vector<std::string>& words,
                         const std::function<bool()>& prepare, pid_t parent, int reason) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing > 0) dup2(nothing, STDIN_FILENO);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  if (prepare()) execvp(arguments[0], arguments.data());
  const int error = errno;
  [[maybe_unused]] const auto written = write(reason, &error, sizeof error);
  _exit(127);
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

Pipe::Pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    throw schema::UserError(
        schema::Cause::failure,
        std::string("no pipe can be created (") + std::strerror(errno) + "); close some programs");
  }
  read_end_ = ends[0];
  write_end_ = ends[1];
}

Pipe::~Pipe() {
  close(read_end_);
  close_write_end();
}

void Pipe::close_write_end() {
  if (write_end_ >= 0) close(write_end_);
  write_end_ = -1;
}

ChildProcess::ChildProcess(const std::vector<std::string>& words,
                           const std::function<bool()>& prepare) {
  Pipe reason;
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) become(words, prepare, parent, reason.write_end());
  if (process_ < 0) {
    error_ = errno;
    return;
  }
  reason.close_write_end();
  // Nothing comes once the program has taken the child's place.
  if (read(reason.read_end(), &error_, sizeof error_) != sizeof error_) error_ = 0;
  if (error_ != 0) waitpid(process_, nullptr, 0);
}

bool ChildProcess::has_ended() {
  if (!has_ended_) has_ended_ = wait4(process_, &status_, WNOHANG, &usage_) == process_;
  return has_ended_;
}

void ChildProcess::send(int signal) const { kill(process_, signal); }

int ChildProcess::exit_code() const {
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

double ChildProcess::cpu_s() const { return seconds(usage_.ru_utime) + seconds(usage_.ru_stime); }

double ChildProcess::memory_mb() const { return static_cast<double>(usage_.ru_maxrss) / 1024; }

}  // namespace misalign::search
