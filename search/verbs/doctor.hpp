// `misalign doctor`: the checks of a machine, or of all that mpirun starts it on.
#pragma once

#include <string>

namespace misalign::search {

/// `directory` is where catalogues are to be. Prints on rank 0; the exit code: 1 if anything is
/// bad.
int run_doctor(const std::string& directory, bool json);

}  // namespace misalign::search
