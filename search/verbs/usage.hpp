// Explains what is wrong with the words of a command line.
#pragma once

#include <string>

#include "schema/files/user_error.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {

/// The verb that was typed; null if there was none.
const CLI::App* chosen_verb(const CLI::App& app);

/// A pattern of the shell's, such as results/miura-*.db, that matches more files than the verb
/// takes would give the second one to the next argument. `words` as the shell gave them, without
/// the program's name. Empty if there is nothing to say.
std::string too_many_files(const CLI::App& verb, const Words& words);

/// A file that is read under one name and would be replaced under --output. Empty if there is none.
std::string output_among_inputs(const CLI::App& verb);

/// Names the unknown word, and the one that may have been meant; else `otherwise`, CLI11's
/// sentence, with options by the names that were typed.
std::string usage_sentence(const CLI::App& app, const Words& words, const std::string& otherwise);

/// A failure's sentence. A faulty number of the file's design is named by its key, not by an option
/// that was not typed.
std::string sentence_as_given(const CLI::App& verb, const schema::UserError& failure);

}  // namespace misalign::search
