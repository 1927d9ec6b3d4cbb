#pragma once

#include <string>

#include "schema/catalogue/catalogue.hpp"
#include "search/terminal/usable_threads.hpp"

namespace misalign::search {

std::string host_name();

/// Describes this program on this machine for a run's row.
schema::RunInfo run_info(const std::string& golden_verdicts, int ranks);

}  // namespace misalign::search
