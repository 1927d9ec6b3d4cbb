// Tells how many threads this process may run at once.
#pragma once

#include <sched.h>

namespace misalign::search {

/// Hardware threads that this process may run on.
inline int usable_threads() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

}  // namespace misalign::search
