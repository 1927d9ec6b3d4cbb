// The verbs of the command line: each adds its options, and says what to do once they are read.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace misalign::search {

/// Returns the exit code; throws UserError.
using Action = std::function<int()>;

// Those that run something.
/// `words` as typed, the program's name first: to start them again under mpirun.
Action add_search(CLI::App& app, const std::vector<std::string>& words);
Action add_merge(CLI::App& app);
Action add_config(CLI::App& app);
Action add_doctor(CLI::App& app);
Action add_bench(CLI::App& app);
Action add_completion(CLI::App& app);
/// After all others: it says what they are.
Action add_help(CLI::App& app);

// Those that look at a pattern or a catalogue.
Action add_status(CLI::App& app);
Action add_fold(CLI::App& app);
Action add_perforations(CLI::App& app);
Action add_replay(CLI::App& app);
Action add_query(CLI::App& app);
Action add_actuators(CLI::App& app);
Action add_verify(CLI::App& app);
Action add_tolerance(CLI::App& app);

// Those that take candidates away.
Action add_export(CLI::App& app);
Action add_report(CLI::App& app);

/// A number within bounds, which NaN is not.
CLI::Validator within(double least, double most);

/// A share of one within bounds; what was meant as percent is told from it.
CLI::Validator a_share(double least, double most);

/// A whole number within bounds, written as one: not 1e6.
CLI::Validator counted(std::uint64_t least, std::uint64_t most);
/// Any number of a draw, or of draws.
CLI::Validator a_draw();

/// The first argument of verbs that look at one sheet, and the second that some of them take.
void add_catalogue_or_pattern(CLI::App& verb, std::string& path);
void add_draw_of_catalogue(CLI::App& verb, std::optional<std::uint64_t>& draw);

/// What is typed, and what it stands for.
using Names = std::vector<std::pair<std::string, std::string>>;

/// One of the names; `where` ends the sentence about any other.
CLI::Validator one_of(const Names& names, const std::string& where = "");

/// One of the words, of which the nearest is suggested for any other: "x is no verb".
CLI::Validator known_word(const std::string& kind, const std::vector<std::string>& known);

template <class Enum>
std::string number_of(Enum value) {
  return std::to_string(static_cast<int>(value));
}

}  // namespace misalign::search
