// The command line: verbs, options, help.
#pragma once

#include "search/verbs/verbs.hpp"

namespace misalign::search {

/// Runs the verb that the words name, with these parts; returns the exit code of the contract.
int run_command_line(int argc, char** argv, const Parts& parts,
                     std::vector<Verb> (*verbs)(const Words&, const Parts&));

}  // namespace misalign::search
