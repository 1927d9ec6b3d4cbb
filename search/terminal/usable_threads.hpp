// Tells how many threads this process may run at once.
#pragma once

namespace misalign::search {

/// Hardware threads that this process may run on.
int usable_threads();

}  // namespace misalign::search
