#include "search/terminal/process_start.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

namespace misalign::search {
namespace {

void fill_descriptors() {
  for (;;) {
    int opened = ::open("/dev/null", O_RDONLY);
    if (opened < 0) opened = ::open("/", O_RDONLY);  // where there are no devices
    if (opened < 0) ::_exit(1);                      // nothing could be said to anybody
    if (opened <= STDERR_FILENO) continue;
    ::close(opened);
    return;
  }
}

}  // namespace

void prepare_process() {
  fill_descriptors();
  // A handler, which unlike SIG_IGN no pager inherits.
  struct sigaction nothing {};
  nothing.sa_handler = [](int) {};
  nothing.sa_flags = SA_RESTART;
  ::sigaction(SIGXFSZ, &nothing, nullptr);
  std::signal(SIGCHLD, SIG_DFL);  // ignored by a parent, nobody could wait for a child
}

}  // namespace misalign::search
