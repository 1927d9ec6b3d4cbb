#pragma once

#include <string>

#include "schema/catalogue/catalogue.hpp"

namespace misalign::search {

std::string host_name();

/// Hardware threads that this process may run on.
int usable_threads();

/// This program on this machine, as a run's row says it.
schema::RunInfo run_info(const std::string& golden_verdicts, int ranks);

}  // namespace misalign::search
