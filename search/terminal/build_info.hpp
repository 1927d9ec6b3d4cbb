// Describes the build of this program, which every run records.
#pragma once

#include <string>

namespace misalign::search {

struct BuildInfo {
  std::string version, commit, compiler, flags;
};

const BuildInfo& build_info();

}  // namespace misalign::search
