// --ranks and --jobs of the verbs that share their work out among ranks or threads.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "search/verbs/verbs.hpp"

namespace misalign::search {

/// "all", or a number; empty where nothing was typed.
void add_ranks(CLI::App& verb, std::string& ranks);

/// --jobs: what usable_threads() returns from then on.
void add_jobs(CLI::App& verb);

/// The number of ranks to start; 1 without --ranks. UserError (bad_request) under mpirun.
int ranks_wanted(const std::string& ranks);

/// Runs the typed command on `ranks` ranks of this machine, with a bar of progress where
/// `with_bar`, and returns its exit code: `stopped_exit` where a signal has ended it.
int run_on_ranks(int ranks, const Words& typed, bool with_bar, int stopped_exit);

}  // namespace misalign::search
