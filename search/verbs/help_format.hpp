// Formats --help as GNU programs do, so that help2man can make manual pages of it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace misalign::search {

/// The group of options that no help, completion or suggestion shows: those for tests.
inline constexpr const char* kHidden = "";

/// Prints usage, the footer before its "Examples:", arguments, options, the examples.
class HelpFormat : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
};

/// The verbs, in the order of --help.
std::vector<const CLI::App*> verbs_of(const CLI::App& app);
/// A verb's options with those of its groups and the program's own; or the program's alone.
std::vector<const CLI::Option*> options_of(const CLI::App& app);
std::vector<const CLI::Option*> positionals_of(const CLI::App& app);

/// Returns whether the option takes any number of words.
bool takes_many(const CLI::Option& option);
/// Returns whether `word`, as typed, is an option of the verb whose value is the next word.
bool takes_next_word(const CLI::App& verb, const std::string& word);

/// "-h", "--help"
std::vector<std::string> names_of(const CLI::Option& option);
/// The placeholder of its value: "N", "CAMPAIGN", "json|csv"; empty for a flag.
std::string value_name(const CLI::Option& option);
/// The values, if they are a fixed set.
std::vector<std::string> fixed_values(const CLI::Option& option);

}  // namespace misalign::search
