// Completion scripts, made from the options that the program has: they cannot go stale. They never
// call the program.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace misalign::search {

std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);

}  // namespace misalign::search
