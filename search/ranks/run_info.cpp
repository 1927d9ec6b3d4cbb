#include "search/ranks/run_info.hpp"

#include <unistd.h>

#include "search/terminal/build_info.hpp"

namespace misalign::search {

std::string host_name() {
  char name[256] = "unknown";
  gethostname(name, sizeof name - 1);
  return name;
}

schema::RunInfo run_info(const std::string& golden_verdicts, int ranks) {
  const BuildInfo& build = build_info();
  return {host_name(), build.version,   build.commit, build.compiler,
          build.flags, golden_verdicts, ranks};
}

}  // namespace misalign::search
