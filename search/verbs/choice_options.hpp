// --best, --diverse, --where and --by of the verbs that take chosen candidates.
#pragma once

#include <CLI/CLI.hpp>

#include "search/sheets/choice.hpp"

namespace misalign::search {

struct ChoiceOptions {
  CLI::Option *best, *diverse, *where, *by;
};

/// Adds them to the verb, all but --by inside its group; --draw is the verb's own.
ChoiceOptions add_choice(CLI::App& verb, CLI::App& group, Choice& choice);

/// UserError (bad_request) where --by is given without --best or --diverse.
void check_by(const Choice& choice);

}  // namespace misalign::search
