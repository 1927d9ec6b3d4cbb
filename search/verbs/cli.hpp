// The command line: verbs, options, help.
#pragma once

#include "search/verbs/verbs.hpp"

namespace misalign::search {

/// Does what the words ask for, by one of these verbs; returns the exit code of the contract.
int run_command_line(int argc, char** argv, std::vector<Verb> (*verbs)(const Words&));

}  // namespace misalign::search
