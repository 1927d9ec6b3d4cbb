#pragma once

#include <string>

#include "schema/catalogue/catalogue.hpp"
#include "search/terminal/usable_threads.hpp"

namespace misalign::search {

std::string host_name();

/// This program on this machine, as a run's row says it.
schema::RunInfo run_info(const std::string& golden_verdicts, int ranks);

}  // namespace misalign::search
