// --ranks of the verbs that share their work out among ranks.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace misalign::search {

/// "all", or how many; empty where nothing was typed.
void add_ranks(CLI::App& verb, std::string& ranks);

/// How many ranks are to be started; 1 where nobody asked. UserError (2) under mpirun.
int ranks_wanted(const std::string& ranks);

}  // namespace misalign::search
