// Validators of options: which values an option takes, and the sentence about any other.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace misalign::search {

/// A number within bounds, which NaN is not.
CLI::Validator within(double least, double most);
/// A number within the bounds of a key of the design block.
CLI::Validator within(std::string_view design_key);
/// A number within the limits of a study's parameter; `counted`: a whole number.
CLI::Validator within(std::string_view study, std::string_view parameter);
CLI::Validator counted(std::string_view study, std::string_view parameter);

/// A share of 1 within bounds; percent is recognised and corrected in the sentence.
CLI::Validator a_share(double least, double most);

/// A whole number within bounds, written as one: not 1e6.
CLI::Validator counted(std::uint64_t least, std::uint64_t most);
/// Any number of a draw, or of draws.
CLI::Validator a_draw();

/// Typed words with their values.
template <class Value>
using Names = std::vector<std::pair<std::string, Value>>;

/// One of the names, of an enum's values; `where` ends the sentence about any other.
CLI::Validator one_of_words(const Names<std::string>& names, const std::string& where);
template <class Enum>
CLI::Validator one_of(const Names<Enum>& names, const std::string& where = "") {
  Names<std::string> numbers;  // which CLI11 makes the enum's value of
  for (const auto& [name, value] : names) {
    numbers.emplace_back(name, std::to_string(static_cast<int>(value)));
  }
  return one_of_words(numbers, where);
}

/// One of the words, of which the nearest is suggested for any other: "x is no verb".
CLI::Validator known_word(const std::string& kind, const std::vector<std::string>& known);

/// Adds an option whose value, of this unit, the validator takes.
template <class Value>
CLI::Option* add_value(CLI::App& verb, const std::string& name, Value& value,
                       const std::string& meaning, CLI::Validator check, const std::string& unit) {
  return verb.add_option(name, value, meaning)->check(std::move(check))->type_name(unit);
}

/// The same, with the value that it has to begin with behind its meaning: "how many [1000]".
template <class Value>
CLI::Option* add_default(CLI::App& verb, const std::string& name, Value& value,
                         const std::string& meaning, CLI::Validator check,
                         const std::string& unit) {
  constexpr const char* kFormat = std::is_floating_point_v<Value> ? "{} [{:g}]" : "{} [{}]";
  return add_value(verb, name, value, fmt::format(fmt::runtime(kFormat), meaning, value),
                   std::move(check), unit);
}

}  // namespace misalign::search
