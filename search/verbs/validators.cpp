#include "search/verbs/validators.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "schema/campaign/draw_range.hpp"
#include "schema/files/input.hpp"
#include "schema/files/suggestion.hpp"
#include "schema/pattern/design.hpp"
#include "schema/pattern/parameters.hpp"

namespace misalign::search {
namespace {

// Suggests the share that was meant where percent was typed.
std::string share_meant(double value, double least, double most) {
  const double meant = value / 100;
  if (value <= most || meant < least || meant > most) return "";
  return " (a share, not percent; did you mean " + schema::shown_number(meant) + "?)";
}

// The form that --help and completion read: {auto,plain}.
std::string shown_set(const std::vector<std::string>& names) {
  return fmt::format("{{{}}}", fmt::join(names, ","));
}

}  // namespace

CLI::Validator within(double least, double most) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double value = 0;
        const bool is_decimal = text.find_first_not_of("0123456789+-.eE") == std::string::npos;
        if (is_decimal && CLI::detail::lexical_cast(text, value) && value >= least &&
            value <= most) {
          return "";
        }
        return text + " is not a number from " + schema::shown_number(least) + " to " +
               schema::shown_number(most);
      },
      "");
}

CLI::Validator within(std::string_view design_key) {
  const auto [least, most] = schema::design_limits(design_key);
  return within(least, most);
}

CLI::Validator within(std::string_view study, std::string_view parameter) {
  const auto [least, most] = schema::parameter_limits(study, parameter);
  return within(least, most);
}

CLI::Validator a_share(double least, double most) {
  const CLI::Validator number = within(least, most);
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        const std::string fault = number(text);
        double value = 0;
        if (fault.empty() || !CLI::detail::lexical_cast(text, value)) return fault;
        return fault + share_meant(value, least, most);
      },
      "");
}

CLI::Validator counted(std::uint64_t least, std::uint64_t most) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = error == std::errc{} && stop == text.data() + text.size();
        if (whole && value >= least && value <= most) return "";
        return text + " is not a whole number from " + std::to_string(least) + " to " +
               std::to_string(most) + ", written with digits alone";
      },
      "");
}

CLI::Validator counted(std::string_view study, std::string_view parameter) {
  const auto [least, most] = schema::parameter_limits(study, parameter);
  return counted(static_cast<std::uint64_t>(least), static_cast<std::uint64_t>(most));
}

CLI::Validator a_draw() { return counted(0, schema::kEndOfDraws); }

CLI::Validator one_of_words(const Names<std::string>& names, const std::string& where) {
  std::vector<std::string> typed;
  for (const auto& [name, value] : names) typed.push_back(name);
  return CLI::Validator(
      [=](std::string& text) {
        for (const auto& [name, value] : names) {
          if (text != name) continue;
          text = value;
          return std::string();
        }
        return fmt::format("'{}' is none of {}{}", text, fmt::join(typed, ", "), where);
      },
      shown_set(typed));
}

CLI::Validator known_word(const std::string& kind, const std::vector<std::string>& known) {
  return CLI::Validator(
      [=](const std::string& text) {
        const bool is_known = std::find(known.begin(), known.end(), text) != known.end();
        return is_known ? std::string() : schema::unknown_word(text, kind, known);
      },
      shown_set(known));
}

}  // namespace misalign::search
