#include "search/terminal/usable_threads.hpp"

#include <sched.h>

namespace misalign::search {

int usable_threads() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

}  // namespace misalign::search
