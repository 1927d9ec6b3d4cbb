#include "search/verbs/help_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace misalign::search {
namespace {

constexpr std::size_t kIndent = 26, kWidth = 79;

// "  name      text", the text wrapped and indented; below the name if that is long.
std::string entry(const std::string& name, const std::string& text) {
  std::string lines = "  " + name, line;
  std::size_t used = lines.size();
  if (used + 2 > kIndent) {
    lines += "\n";
    used = 0;
  }
  lines += std::string(kIndent - used, ' ');
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!line.empty() && kIndent + line.size() + 1 + word.size() > kWidth) {
      lines += line + "\n" + std::string(kIndent, ' ');
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + line + "\n";
}

std::string section(const std::string& title, const std::vector<const CLI::Option*>& options) {
  if (options.empty()) return "";
  std::string text = "\n" + title + ":\n";
  for (const CLI::Option* option : options) {
    if (option->get_positional()) {
      text += entry(option->get_name(true), option->get_description());
      continue;
    }
    const std::string value = value_name(*option);
    const std::string needed = option->get_required() ? " (required)" : "";
    text += entry(
        fmt::format("{}{}{}", fmt::join(names_of(*option), ", "), value.empty() ? "" : " ", value),
        option->get_description() + needed);
  }
  return text;
}

std::vector<const CLI::Option*> own_options(const CLI::App& app) {
  const bool is_group = app.get_name().empty();  // its --help is hidden
  return app.get_options([&](const CLI::Option* option) {
    return option->nonpositional() && option->get_group() != kHidden &&
           !(is_group && option == app.get_help_ptr());
  });
}

std::vector<const CLI::App*> option_groups(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* sub) { return sub->get_name().empty(); });
}

// The program's options that a verb takes too.
std::vector<const CLI::Option*> shared_options(const CLI::App& program) {
  return program.get_options([&](const CLI::Option* option) {
    return option->nonpositional() && option != program.get_help_ptr() &&
           !option->check_lname("version");
  });
}

std::string usage(const CLI::App& app) {
  std::string line = "Usage: ";
  if (app.get_parent()) line += app.get_parent()->get_name() + " ";
  line += app.get_name() + " [OPTION]...";
  for (const CLI::Option* option : positionals_of(app)) {
    const std::string name = option->get_name(true) + (takes_many(*option) ? "..." : "");
    line += " " + (option->get_required() ? name : "[" + name + "]");
  }
  if (!verbs_of(app).empty()) line += " VERB";
  return line + "\n";
}

}  // namespace

std::string HelpFormat::make_help(const CLI::App* app, std::string /*name*/,
                                  CLI::AppFormatMode /*mode*/) const {
  std::string description = app->get_description(), notes = app->get_footer(), examples;
  description[0] = static_cast<char>(std::toupper(description[0]));
  if (description.back() != '.') description += '.';
  const std::size_t begin = notes.find("Examples:");
  if (begin != std::string::npos) {
    examples = "\n" + notes.substr(begin) + "\n";
    notes.erase(begin);
  }
  while (!notes.empty() && notes.back() == '\n') notes.pop_back();
  std::string text = usage(*app) + description + "\n" + (notes.empty() ? "" : "\n" + notes + "\n");
  text += section("Arguments", positionals_of(*app));
  const std::vector<const CLI::App*> verbs = verbs_of(*app);
  if (!verbs.empty()) text += "\nVerbs:\n";
  for (const CLI::App* verb : verbs) text += entry(verb->get_name(), verb->get_description());
  for (const CLI::App* group : option_groups(*app)) {
    const bool one_only = group->get_require_option_max() == 1;
    std::string title = group->get_description() + (one_only ? " (exactly one of these)" : "");
    title[0] = static_cast<char>(std::toupper(title[0]));
    text += section(title, own_options(*group));
  }
  text += section("Options", own_options(*app));
  if (app->get_parent())
    text += section("Options of every verb", shared_options(*app->get_parent()));
  return text + examples;
}

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* sub) { return !sub->get_name().empty(); });
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  std::vector<const CLI::Option*> options = own_options(app);
  const auto append = [&](const std::vector<const CLI::Option*>& more) {
    options.insert(options.end(), more.begin(), more.end());
  };
  for (const CLI::App* group : option_groups(app)) append(own_options(*group));
  if (app.get_parent()) append(shared_options(*app.get_parent()));
  return options;
}

std::vector<const CLI::Option*> positionals_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

bool takes_many(const CLI::Option& option) {
  return option.get_expected_max() >= CLI::detail::expected_max_vector_size;
}

bool takes_next_word(const CLI::App& verb, const std::string& word) {
  for (const CLI::Option* option : options_of(verb)) {
    const std::vector<std::string> names = names_of(*option);
    if (std::find(names.begin(), names.end(), word) != names.end()) {
      return !value_name(*option).empty();
    }
  }
  return false;
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string value_name(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  if (const auto values = fixed_values(option); !values.empty()) {
    return fmt::to_string(fmt::join(values, "|"));
  }
  std::string name = option.get_type_name();  // with what its checks say of themselves after it
  const std::size_t range = name.find(" in [");
  if (range != std::string::npos) name.erase(name.rfind(':', range));
  return name == "UINT" || name == "INT" ? "N" : name;
}

std::vector<std::string> fixed_values(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  const std::size_t begin = name.find('{'), end = name.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::istringstream list(name.substr(begin + 1, end - begin - 1));
  std::vector<std::string> values;
  for (std::string value; std::getline(list, value, ',');) values.push_back(value);
  return values;
}

}  // namespace misalign::search
