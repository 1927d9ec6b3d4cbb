#include "search/ranks/rank_starter.hpp"

#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>

#include "schema/files/input.hpp"
#include "search/terminal/child_process.hpp"
#include "search/terminal/screen.hpp"
#include "search/terminal/terminal.hpp"

namespace misalign::search {
namespace {

constexpr const char* kStarterVariable = "MISALIGN_STARTER";
// Other processes ignore this signal, should the process number have been reused.
constexpr int kHereIAm = SIGURG;

using schema::UserError;

std::vector<std::string> mpirun_words(int ranks, const std::vector<std::string>& words) {
  const std::string count = std::to_string(ranks);
  // There are as many slots as ranks, even with fewer cores.
  std::vector<std::string> command = {"mpirun",
                                      "--host",
                                      "localhost:" + count,
                                      "--bind-to",
                                      "none",
                                      "-n",
                                      count,
                                      std::filesystem::read_symlink("/proc/self/exe").string()};
  command.insert(command.end(), words.begin(), words.end());
  return command;
}

// Prepares the child process before it execs mpirun.
bool prepare_mpirun(const sigset_t& mask, pid_t starter, int printed) {
  // A separate process group: Ctrl-C reaches the starter alone, which tells rank 0.
  setpgid(0, 0);
  dup2(printed, STDOUT_FILENO);
  setenv(kStarterVariable, std::to_string(starter).c_str(), 1);
  setenv("COLUMNS", std::to_string(terminal_width(STDERR_FILENO)).c_str(), 1);
  // These suppress eleven lines about a rank's exit code. Open MPI 4 and 5 each know one of them;
  // --quiet is an option of 4 alone.
  setenv("OMPI_MCA_orte_execute_quiet", "1", 1);
  setenv("PRTE_MCA_prte_execute_quiet", "1", 1);
  if (geteuid() == 0) {  // whoever runs this as root means it
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  }
  return pthread_sigmask(SIG_SETMASK, &mask, nullptr) == 0;
}

// UserError if there is no such program.
void expect_started(const ChildProcess& launcher) {
  if (launcher.error() == 0) return;
  const std::string option = schema::parameter("ranks"),
                    without = "omit " + option + " to use one core";
  const std::string why =
      launcher.error() == ENOENT
          ? ": mpirun is not in PATH (it starts the ranks); install Open MPI's programs "
            "(Debian: openmpi-bin), or "
          : std::string(": mpirun cannot be started (") + std::strerror(launcher.error()) + "); ";
  throw UserError(schema::Cause::failure, option + why + without);
}

// Passes on the ranks' output: mpirun does not report failed writes, and the output would seem
// complete.
class Printed {
 public:
  explicit Printed(int from) : from_(from), thread_([this] { pass_on(); }) {}
  /// Passes on all output that has arrived.
  ~Printed() {
    launcher_ended_ = true;
    thread_.join();
  }

 private:
  void pass_on() const {
    constexpr int kLook_ms = 50;
    char bytes[1 << 12];
    pollfd in{from_, POLLIN, 0};
    for (;;) {
      const bool is_last_look = launcher_ended_;  // a rank that outlives mpirun may hold the pipe
      const int ready = poll(&in, 1, kLook_ms);
      if (ready == 0 && is_last_look) return;
      if (ready <= 0) continue;
      const ssize_t size = read(from_, bytes, sizeof bytes);
      if (size <= 0) return;
      put_through({bytes, static_cast<std::size_t>(size)});
    }
  }

  const int from_;
  std::atomic<bool> launcher_ended_ = false;
  std::thread thread_;
};

// Waits for mpirun and passes signals on.
class Starter {
 public:
  Starter(ChildProcess& launcher, const sigset_t& watched)
      : launcher_(launcher), watched_(watched) {}

  void wait() {
    while (!launcher_.has_ended()) {
      siginfo_t info;
      if (sigwaitinfo(&watched_, &info) > 0) pass_on(info);
    }
  }

  /// The last signal that asked the search to leave; 0 without one.
  int asked_by() const { return asked_by_; }
  bool asked_twice() const { return asked_twice_; }
  bool ranks_began() const { return rank_zero_ > 0; }

 private:
  void pass_on(const siginfo_t& info) {
    switch (info.si_signo) {
      case kHereIAm:
        rank_zero_ = info.si_pid;
        // A request may have come before rank 0 could listen.
        if (asked_by_) kill(rank_zero_, SIGTERM);
        break;
      case SIGINT:
      case SIGTERM:
      case SIGHUP:
      case SIGXCPU:
      case SIGALRM:
        ask_to_leave(info.si_signo);
        break;
      case SIGUSR1:
      case SIGUSR2:
        launcher_.send(info.si_signo);
        break;
      case SIGTSTP:
        std::fputs(
            "Ctrl-Z is ignored (suspended ranks would count as lost); Ctrl-C ends the search, and "
            "the same command resumes it later\n",
            stderr);
        break;
      default:  // a child has ended
        break;
    }
  }

  // Asks rank 0, which ends the other ranks; then mpirun ends. The second request goes to mpirun
  // too, which ends all ranks.
  void ask_to_leave(int signal) {
    asked_twice_ = asked_by_ != 0;
    asked_by_ = signal;
    if (asked_twice_) launcher_.send(SIGTERM);
    if (rank_zero_ > 0) kill(rank_zero_, SIGTERM);
  }

  ChildProcess& launcher_;
  const sigset_t watched_;
  pid_t rank_zero_ = 0;
  int asked_by_ = 0;
  bool asked_twice_ = false;
};

int exit_code(int code, const Starter& starter, int ranks, int stopped_exit) {
  if (starter.asked_twice()) return 128 + starter.asked_by();
  if (starter.asked_by() && code == kLeftWithStarter) return stopped_exit;
  if (code == stopped_exit) return code;
  if (!starter.ranks_began() && !starter.asked_by()) {
    const std::string count = std::to_string(ranks);
    throw UserError(schema::Cause::failure, "mpirun could not start " + count +
                                                " ranks (exit code " + std::to_string(code) +
                                                "); mpirun --host localhost:" + count + " -n " +
                                                count + " true says why");
  }
  if (code <= 128) return code;  // a rank has reported the reason
  throw UserError(
      schema::Cause::failure,
      std::string("a rank was killed from outside (") + strsignal(code - 128) +
          "; memory may have run out); committed results are kept, and the same command resumes");
}

}  // namespace

int run_under_mpirun(int ranks, const std::vector<std::string>& words, int stopped_exit) {
  sigset_t watched, before;
  sigemptyset(&watched);
  for (const int signal :
       {SIGTERM, SIGINT, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2, SIGCHLD, SIGTSTP, int{kHereIAm}}) {
    sigaddset(&watched, signal);
  }
  struct sigaction hang_up {};
  sigaction(SIGHUP, nullptr, &hang_up);
  if (hang_up.sa_handler != SIG_IGN) sigaddset(&watched, SIGHUP);  // otherwise nohup ignores it
  pthread_sigmask(SIG_BLOCK, &watched, &before);
  Pipe pipe;
  ChildProcess launcher(mpirun_words(ranks, words), [&, starter = getpid()] {
    return prepare_mpirun(before, starter, pipe.write_end());
  });
  pipe.close_write_end();
  expect_started(launcher);
  Starter starter(launcher, watched);
  {
    const Printed printed(pipe.read_end());
    starter.wait();
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return exit_code(launcher.exit_code(), starter, ranks, stopped_exit);
}

bool has_starter() { return std::getenv(kStarterVariable) != nullptr; }

void tell_starter() {
  const char* const starter = std::getenv(kStarterVariable);
  const int process = starter ? std::atoi(starter) : 0;
  if (process > 1) kill(process, kHereIAm);
}

}  // namespace misalign::search
