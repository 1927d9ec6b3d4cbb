#include "search/terminal/process_start.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

namespace misalign::search {
namespace {

void fill_descriptors() {
  for (;;) {
    int opened = ::open("/dev/null", O_RDONLY);
    if (opened < 0) opened = ::open("/", O_RDONLY);  // a system without devices
    if (opened < 0) ::_exit(1);                      // no message could be read
    if (opened <= STDERR_FILENO) continue;
    ::close(opened);
    return;
  }
}

}  // namespace

void prepare_process() {
  fill_descriptors();
  // A pager inherits SIG_IGN, but no handler.
  struct sigaction nothing {};
  nothing.sa_handler = [](int) {};
  nothing.sa_flags = SA_RESTART;
  ::sigaction(SIGXFSZ, &nothing, nullptr);
  std::signal(SIGCHLD, SIG_DFL);  // an ignored one would make waiting impossible
}

}  // namespace misalign::search
