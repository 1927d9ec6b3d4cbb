#include "search/verbs/usage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "schema/files/suggestion.hpp"
#include "schema/pattern/design_json.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/help_format.hpp"

namespace misalign::search {
namespace {

// Words that are neither a verb's options nor their values, as the shell gave them.
std::vector<std::string> arguments_of(const CLI::App& verb, const Words& words) {
  std::vector<std::string> arguments;
  bool only_arguments = false;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string& word = words[k];
    if (only_arguments || word.size() < 2 || word[0] != '-') {
      arguments.push_back(word);
    } else if (word == "--") {
      only_arguments = true;
    } else if (takes_next_word(verb, word)) {
      ++k;
    }
  }
  if (!arguments.empty()) arguments.erase(arguments.begin());  // the verb's name
  return arguments;
}

// CLI11 calls an option by its first name.
std::string by_typed_names(const CLI::App& verb, const Words& words, std::string sentence) {
  const auto is_typed = [&](const std::string& name) {
    return std::ranges::any_of(
        words, [&](const std::string& word) { return word.substr(0, word.find('=')) == name; });
  };
  for (const CLI::Option* option : options_of(verb)) {
    const std::vector<std::string> names = names_of(*option);
    const auto typed = std::ranges::find_if(names, is_typed);
    const std::string head = option->get_name() + ":";
    if (typed == names.end() || !sentence.starts_with(head)) continue;
    sentence.replace(0, head.size() - 1, *typed);
  }
  return sentence;
}

// "design.springs.stroke_limit" of the parameter "stroke_limit"; empty where designs have none.
std::string place_in_design(const std::string& parameter) {
  if (parameter == "fill") return "design.fill";
  const schema::Json design = schema::design_json({});
  if (design.contains(parameter)) return "design." + parameter;
  for (const auto& [block, numbers] : design.items()) {
    if (numbers.is_object() && numbers.contains(parameter)) {
      return "design." + block + "." + parameter;
    }
  }
  return "";
}

}  // namespace

const CLI::App* chosen_verb(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? nullptr : chosen.front();
}

std::string too_many_files(const CLI::App& verb, const Words& words) {
  for (const CLI::Option* argument : positionals_of(verb)) {
    const bool takes_draws = argument->get_name(/*positional=*/true) == "DRAW";
    if (takes_many(*argument) && !takes_draws) return "";
  }
  const std::vector<std::string> arguments = arguments_of(verb, words);
  const auto is_like_first = [&](const std::string& word) {
    const std::filesystem::path path(word), first(arguments.front());
    std::error_code ignored;
    return path.has_extension() && path.extension() == first.extension() &&
           std::filesystem::is_regular_file(path, ignored);
  };
  std::string names;
  int files = 0;
  constexpr int kShown = 4;
  for (const std::string& word : arguments) {
    if (!is_like_first(word)) continue;
    if (++files <= kShown) names += (files > 1 ? ", " : "") + word;
  }
  if (files < 2) return "";
  return (files == 2 ? "two" : std::to_string(files)) + " files match (" + names +
         (files > kShown ? ", ..." : "") + ") and " + verb.get_name() + " takes one; name one";
}

std::string output_among_inputs(const CLI::App& verb) {
  const CLI::Option* const output = verb.get_option_no_throw("--output");
  if (!output || output->count() == 0) return "";
  const std::string path = output->results().front();
  for (const CLI::Option* option : verb.get_options()) {
    const bool is_file = option->get_positional() || value_name(*option) == "FILE";
    if (option == output || !is_file) continue;
    for (const std::string& input : option->results()) {
      std::error_code ignored;  // what is not there is not replaced
      if (std::filesystem::is_regular_file(input, ignored) &&
          std::filesystem::equivalent(input, path, ignored)) {
        return "--output " + path + " is " + input +
               ", which is read (it would be lost); name another file";
      }
    }
  }
  return "";
}

std::string usage_sentence(const CLI::App& app, const Words& words, const std::string& otherwise) {
  const CLI::App* const verb = chosen_verb(app);
  for (const std::string& word : app.remaining(/*recurse=*/true)) {
    const bool is_option = word.size() > 1 && word[0] == '-';
    if (!is_option && verb) {
      return verb->get_name() + " takes no further argument, such as " + word;
    }
    std::vector<std::string> known;
    if (is_option) {
      for (const CLI::Option* option : options_of(verb ? *verb : app)) {
        for (const std::string& name : names_of(*option)) known.push_back(name);
      }
    } else {
      for (const CLI::App* each : verbs_of(app)) known.push_back(each->get_name());
    }
    return schema::unknown_word(
        word.substr(0, word.find('=')),
        !is_option ? "verb" : "option" + (verb ? " of " + verb->get_name() : ""), known);
  }
  return verb ? by_typed_names(*verb, words, otherwise) : "a verb is missing";
}

std::string sentence_as_given(const CLI::App& verb, const schema::UserError& failure) {
  std::string sentence = failure.sentence(option_of);
  // Advice to a verb without --fill names the key of its file.
  constexpr std::string_view kFill = "--fill ";
  const std::size_t advice = sentence.rfind(kFill);
  if (advice != sentence.npos && !verb.get_option_no_throw("--fill")) {
    sentence.replace(advice, kFill.size(), "design.fill = ");
  }
  const std::string parameter(failure.what(), std::strcspn(failure.what(), "="));
  const std::string place = place_in_design(parameter), head = option_of(parameter, true);
  const CLI::Option* const option = verb.get_option_no_throw(option_of(parameter, false));
  const bool is_typed = option && option->count() > 0;
  if (place.empty() || is_typed || !sentence.starts_with(head)) return sentence;
  return place + " = " + sentence.substr(head.size());
}

}  // namespace misalign::search
