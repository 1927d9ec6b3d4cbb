#include "search/sheets/calculix_run.hpp"

#include <fcntl.h>
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
#include "search/terminal/child_process.hpp"

namespace misalign::search {
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
  throw schema::UserError(
      schema::Cause::failure,
      "there is no ccx in PATH (CalculiX, which bends the panels; directories that do not begin "
      "with / are ignored); install it (Debian: calculix-ccx)");
}

RunDirectory::RunDirectory(const std::string& parent, const std::string& job)
    : parent_(parent), job_(job), path_(job_file(parent, job, ".run-XXXXXX")) {
  if (mkdtemp(path_.data())) return;
  throw schema::UserError(schema::Cause::failure, parent + ": no directory can be made in it (" +
                                                      std::strerror(errno) + "); choose another " +
                                                      schema::parameter("output"));
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
    throw schema::UserError(schema::Cause::failure, to.string() + ": cannot be replaced (" +
                                                        error.message() +
                                                        "); what ccx wrote is in " + path_);
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
  constexpr int kLooksToEnd = 25;  // after SIGTERM
  const std::string log = job_file(directory, job, ".log");
  ChildProcess child({ccx, "-i", job}, [&] {
    const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666);
    return file >= 0 && dup2(file, STDOUT_FILENO) >= 0 && dup2(file, STDERR_FILENO) >= 0 &&
           chdir(directory.c_str()) == 0;
  });
  if (child.error() != 0) {
    throw schema::UserError(schema::Cause::failure, ccx + ": cannot be started (" +
                                                        std::strerror(child.error()) +
                                                        "); try it by hand, with -i " + job);
  }
  CalculixEnd end;
  for (int looks = 0; !child.has_ended();) {
    end.was_stopped = end.was_stopped || !goes_on();
    if (end.was_stopped && looks++ % kLooksToEnd == 0) child.send(looks == 1 ? SIGTERM : SIGKILL);
    std::this_thread::sleep_for(kPollInterval);
  }
  end.exit_code = child.exit_code();
  end.cpu_s = child.cpu_s();
  end.memory_mb = child.memory_mb();
  return end;
}

}  // namespace misalign::search
