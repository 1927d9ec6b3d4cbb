// Tells how many threads this process may run at once.
#pragma once

#include <sched.h>

#include <optional>

namespace misalign::search {

/// The value of --jobs; none where it is not typed.
inline std::optional<int> typed_jobs;

/// Those of --jobs, or all hardware threads that this process may run on.
inline int usable_threads() {
  if (typed_jobs) return *typed_jobs;
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

}  // namespace misalign::search
