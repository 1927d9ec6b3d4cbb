// The build of this program, recorded with every run.
#pragma once

#include <string>

namespace misalign::search {

struct BuildInfo {
  std::string version, commit, compiler, flags;
};

const BuildInfo& build_info();

}  // namespace misalign::search
