// The command line: verbs, options, help.
#pragma once

namespace misalign::search {

/// Does what the words ask for; returns the exit code of the contract.
int run_command_line(int argc, char** argv);

}  // namespace misalign::search
