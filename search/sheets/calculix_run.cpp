#include "search/sheets/calculix_run.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <thread>

#include "schema/files/input.hpp"

namespace misalign::search {
namespace {

// Child: exec ccx; on failure send errno through the pipe.
[[noreturn]] void become_calculix(const std::string& ccx, const std::string& directory,
                                  const std::string& job, pid_t parent, int reason) {
  const std::string log = job_file(directory, job, ".log");
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);
  const int nothing = open("/dev/null", O_RDONLY);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666);
  if (nothing >= 0 && file >= 0 && chdir(directory.c_str()) == 0) {
    dup2(nothing, STDIN_FILENO);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    execl(ccx.c_str(), "ccx", "-i", job.c_str(), static_cast<char*>(nullptr));
  }
  const int error = errno;
  [[maybe_unused]] const auto written = write(reason, &error, sizeof error);
  _exit(127);
}

pid_t started(const std::string& ccx, const std::string& directory, const std::string& job) {
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) {
    throw schema::UserError(
        schema::kExitFailure,
        std::string("no pipe can be made (") + std::strerror(errno) + "); close some programs");
  }
  const pid_t parent = getpid(), child = fork();
  if (child == 0) become_calculix(ccx, directory, job, parent, pipe_ends[1]);
  const int fork_error = errno;
  close(pipe_ends[1]);
  int error = child < 0 ? fork_error : 0;
  if (child > 0 && read(pipe_ends[0], &error, sizeof error) != sizeof error) error = 0;
  close(pipe_ends[0]);
  if (error == 0) return child;
  if (child > 0) waitpid(child, nullptr, 0);
  throw schema::UserError(
      schema::kExitFailure,
      ccx + ": cannot be started (" + std::strerror(error) + "); try it by hand, with -i " + job);
}

}  // namespace

std::string find_calculix() {
  namespace fs = std::filesystem;
  const char* const path = std::getenv("PATH");
  std::istringstream directories(path ? path : "");
  for (std::string directory; std::getline(directories, directory, ':');) {
    const fs::path ccx = fs::path(directory) / "ccx";
    std::error_code ignored;
    if (ccx.is_absolute() && fs::is_regular_file(ccx, ignored) && access(ccx.c_str(), X_OK) == 0) {
      return ccx.string();
    }
  }
  throw schema::UserError(schema::kExitFailure,
                          "there is no ccx in PATH (CalculiX, which bends the panels; directories "
                          "that do not begin with / are not looked at); install it (Debian: "
                          "calculix-ccx)");
}

RunDirectory::RunDirectory(const std::string& parent, const std::string& job)
    : parent_(parent), job_(job), path_(job_file(parent, job, ".run-XXXXXX")) {
  if (mkdtemp(path_.data())) return;
  throw schema::UserError(schema::kExitFailure, parent + ": no directory can be made in it (" +
                                                    std::strerror(errno) +
                                                    "); choose another --output");
}

RunDirectory::~RunDirectory() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void RunDirectory::publish() const {
  namespace fs = std::filesystem;
  for (const char* ending : kJobEndings) {
    const fs::path from = job_file(path_, job_, ending), to = job_file(parent_, job_, ending);
    std::error_code error;
    fs::remove(to, error);
    if (!error && fs::is_regular_file(fs::symlink_status(from))) fs::rename(from, to, error);
    if (!error) continue;
    throw schema::UserError(schema::kExitFailure, to.string() + ": cannot be replaced (" +
                                                      error.message() + "); what ccx wrote is in " +
                                                      path_);
  }
  std::error_code ignored;
  fs::remove_all(path_, ignored);  // such as spooles.out, of all jobs
}

std::string job_file(const std::string& directory, const std::string& job, const char* ending) {
  return (std::filesystem::absolute(directory) / (job + ending)).string();
}

CalculixEnd run_calculix(const std::string& ccx, const std::string& directory,
                         const std::string& job, const std::function<bool()>& goes_on) {
  constexpr auto kPollInterval = std::chrono::milliseconds(200);
  constexpr int kLooksToEnd = 25;  // after it was asked to
  const pid_t child = started(ccx, directory, job);
  CalculixEnd end;
  int status = 0, looks = 0;
  rusage usage{};
  while (wait4(child, &status, WNOHANG, &usage) != child) {
    end.was_stopped = end.was_stopped || !goes_on();
    if (end.was_stopped && looks++ % kLooksToEnd == 0) kill(child, looks == 1 ? SIGTERM : SIGKILL);
    std::this_thread::sleep_for(kPollInterval);
  }
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  end.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  end.memory_mb = static_cast<double>(usage.ru_maxrss) / 1024;
  return end;
}

}  // namespace misalign::search
