// `misalign completion`: completion scripts, made from the options that the program has: they
// cannot go stale. They never call the program.
#include <fmt/format.h>

#include "schema/catalogue/named_queries.hpp"
#include "schema/pattern/hinge_table.hpp"
#include "schema/pattern/material_table.hpp"
#include "search/terminal/shell_word.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/help_format.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

enum class Kind { words, names, names_or_files, files, directories, text };

// The words or files that complete an argument or the value of an option.
struct Offer {
  Kind kind = Kind::text;
  // The words, with spaces between; names, with bars; or how the files' names end, if known.
  std::string detail = {};
};

std::string joined(const std::vector<std::string>& words) {
  return fmt::to_string(fmt::join(words, " "));
}

// Names may hold spaces, but no bars.
std::string with_bars(const std::vector<std::string>& names) {
  return fmt::to_string(fmt::join(names, "|"));
}

Offer offer_for(const CLI::Option& option) {
  const std::vector<std::string> fixed = fixed_values(option);
  if (!fixed.empty()) return {Kind::words, joined(fixed)};
  const std::string name = option.get_positional() ? option.get_name(true) : value_name(option);
  if (name == "CAMPAIGN" || name == "PATTERN") return {Kind::files, "json"};
  if (name == "FILE") return {Kind::files};
  if (name == "CATALOGUE" || name == "IN" || name == "OUT") return {Kind::files, "db"};
  if (name == kMaterial) return {Kind::names_or_files, with_bars(schema::material_names())};
  if (name == kHinge) return {Kind::names, with_bars(schema::hinge_names())};
  if (name == "DIRECTORY") return {Kind::directories};
  if (name == "QUERY") return {Kind::words, joined(schema::named_queries())};
  if (option.check_lname("output")) return {Kind::files};
  return {};
}

bool takes_value(const CLI::Option& option) { return !value_name(option).empty(); }

std::string verb_name(const CLI::App& app) { return app.get_parent() ? app.get_name() : ""; }

std::vector<const CLI::App*> program_and_verbs(const CLI::App& program) {
  std::vector<const CLI::App*> apps = verbs_of(program);
  apps.insert(apps.begin(), &program);
  return apps;
}

std::vector<std::string> verb_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* verb : verbs_of(program)) names.push_back(verb->get_name());
  return names;
}

std::string bash_offer(const Offer& offer) {
  switch (offer.kind) {
    case Kind::words:
      return "words " + offer.detail;
    case Kind::names:
      return "names " + offer.detail;
    case Kind::names_or_files:
      return "names_or_files " + offer.detail;
    case Kind::files:
      return "files " + offer.detail;
    case Kind::directories:
      return "directories";
    case Kind::text:
      break;
  }
  return "text";
}

constexpr const char* kBashFunctions = R"bash(
# Completes BEGINNING ($2) by OFFER ($1).
_misalign_offer() {
  case $1 in
    'words '*) mapfile -t COMPREPLY < <(compgen -W "${1#words }" -- "$2") ;;
    'files ') compopt -o filenames 2> /dev/null; mapfile -t COMPREPLY < <(compgen -f -- "$2") ;;
    'names_or_files '*) mapfile -t COMPREPLY < <(compgen -f -- "$2") ;;
    'files '*)
      compopt -o filenames 2> /dev/null
      mapfile -t COMPREPLY < <(compgen -d -- "$2"; compgen -f -X "!*.${1#files }" -- "$2") ;;
    directories) compopt -o filenames 2> /dev/null; mapfile -t COMPREPLY < <(compgen -d -- "$2") ;;
  esac
  [[ $1 == 'words '* ]] && return
  local i name
  for i in "${!COMPREPLY[@]}"; do  # a name with a line feed came as two that are none
    [[ -e ${COMPREPLY[i]/#\~\//$HOME/} ]] || unset "COMPREPLY[i]"
  done
  [[ $1 == names* ]] || return
  local IFS='|'
  for name in ${1#* }; do  # a name has spaces, which are typed with a backslash or within quotes
    [[ $name == "${2//[\\\"\']/}"* ]] || continue
    printf -v name %q "$name"
    COMPREPLY+=("$name")
  done
}

_misalign() {
  local current=${COMP_WORDS[COMP_CWORD]} verb='' place=0 word offer i
  COMPREPLY=()
  [[ $current == '=' ]] && current=''
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    if [[ $word == -* ]]; then
      _misalign_value "$verb" "$word"
      [[ $offer ]] || continue
      [[ ${COMP_WORDS[i + 1]} == '=' ]] && ((++i))
      if ((++i >= COMP_CWORD)); then  # it is this option's value that is being typed
        _misalign_offer "$offer" "$current"
        return
      fi
      while [[ ${COMP_WORDS[i + 1]} == ':' ]]; do ((i += 2)); done  # LO:HI is three words to bash
    elif [[ ! $verb ]]; then
      verb=$word
    else
      ((++place))
    fi
  done
  _misalign_argument "$verb" "$place"
  [[ $current == -* ]] && _misalign_options "$verb"
  _misalign_offer "$offer" "$current"
}

complete -F _misalign misalign
)bash";

// zsh's own rules for text within one of its specifications.
std::string zsh_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

// A command that offers names.
std::string zsh_names(std::string with_bars) {
  for (std::size_t at = 0; (at = with_bars.find('|', at)) != std::string::npos; at += 3) {
    with_bars.replace(at, 1, "\" \"");
  }
  return "compadd -- \"" + with_bars + "\"";
}

std::string zsh_action(const Offer& offer) {
  switch (offer.kind) {
    case Kind::words:
      return "(" + offer.detail + ")";
    case Kind::names:
      return "{" + zsh_names(offer.detail) + "}";
    case Kind::names_or_files:
      return "{" + zsh_names(offer.detail) + "; _files}";
    case Kind::files:
      return offer.detail.empty() ? "_files" : "_files -g \"*." + offer.detail + "\"";
    case Kind::directories:
      return "_files -/";
    case Kind::text:
      break;
  }
  return " ";
}

// The arguments of zsh's _arguments, one a line.
std::string zsh_specifications(const CLI::App& app) {
  const std::string next = " \\\n        ";
  std::string text;
  for (const CLI::Option* option : options_of(app)) {
    const std::vector<std::string> names = names_of(*option);
    const std::string again = takes_many(*option) ? "*" : "(" + joined(names) + ")";
    for (const std::string& name : names) {
      std::string item = again + name;
      if (takes_value(*option) && name.size() > 2) item += "=";
      item += "[" + zsh_text(option->get_description()) + "]";
      if (takes_value(*option)) {
        item += ":" + zsh_text(value_name(*option)) + ":" + zsh_action(offer_for(*option));
      }
      text += next + in_quotes(item);
    }
  }
  int place = 0;
  for (const CLI::Option* option : positionals_of(app)) {
    const std::string where = takes_many(*option) ? "*" : std::to_string(++place);
    const std::string what = option->get_name(true) + ", " + option->get_description();
    text += next + in_quotes(where + ":" + zsh_text(what) + ":" + zsh_action(offer_for(*option)));
  }
  return text;
}

std::string bash_completion(const CLI::App& program) {
  std::string options, values,
      arguments = "    ' 0') offer=" + in_quotes("words " + joined(verb_names(program))) + " ;;\n";
  for (const CLI::App* app : program_and_verbs(program)) {
    const std::string verb = verb_name(*app);
    std::vector<std::string> names;
    for (const CLI::Option* option : options_of(*app)) {
      for (const std::string& name : names_of(*option)) {
        names.push_back(name);
        if (!takes_value(*option)) continue;
        values += "    " + in_quotes(verb + " " + name) +
                  ") offer=" + in_quotes(bash_offer(offer_for(*option))) + " ;;\n";
      }
    }
    options +=
        "    " + in_quotes(verb) + ") offer=" + in_quotes("words " + joined(names)) + " ;;\n";
    int place = 0;
    for (const CLI::Option* option : positionals_of(*app)) {
      const std::string which = takes_many(*option)
                                    ? in_quotes(verb + " ") + "*"
                                    : in_quotes(verb + " " + std::to_string(place++));
      arguments +=
          "    " + which + ") offer=" + in_quotes(bash_offer(offer_for(*option))) + " ;;\n";
    }
  }
  const auto function = [](const std::string& name, const std::string& comment,
                           const std::string& cases) {
    return "\n# " + comment + "\n" + name + "() {\n  offer=''\n  case \"" +
           (name == "_misalign_options" ? "$1" : "$1 $2") + "\" in\n" + cases + "  esac\n}\n";
  };
  return "# Completion of misalign in bash; made by `misalign completion bash`.\n" +
         function("_misalign_options", "The options of VERB.", options) +
         function("_misalign_value", "The value of VERB's OPTION; nothing if it takes none.",
                  values) +
         function("_misalign_argument", "The argument of VERB at PLACE, counted from 0.",
                  arguments) +
         kBashFunctions;
}

std::string zsh_completion(const CLI::App& program) {
  std::string text =
      "#compdef misalign\n"
      "# Completion of misalign in zsh; made by `misalign completion zsh`.\n\n"
      "_misalign() {\n"
      "  local curcontext=$curcontext state line\n"
      "  local -a verbs=(\n";
  for (const CLI::App* verb : verbs_of(program)) {
    text += "    " + in_quotes(verb->get_name() + ":" + zsh_text(verb->get_description())) + "\n";
  }
  text += "  )\n  _arguments -C" + zsh_specifications(program) +
          " \\\n        '1:verb:->verb' \\\n        '*::argument:->arguments' && return\n"
          "  case $state in\n"
          "    verb) _describe verb verbs ;;\n"
          "    arguments)\n"
          "      case $words[1] in\n";
  for (const CLI::App* verb : verbs_of(program)) {
    text += "        " + verb->get_name() + ") _arguments" + zsh_specifications(*verb) + " ;;\n";
  }
  return text +
         "      esac ;;\n"
         "  esac\n"
         "}\n\n"
         "if [[ $funcstack[1] == _misalign ]]; then _misalign \"$@\"; else compdef _misalign "
         "misalign; fi\n";
}

}  // namespace

Action completion_verb(CLI::App& verb) {
  verb.description("completion script for a shell");
  verb.footer(
      "An installed program needs no script where the shell searches the place of installation.\n\n"
      "Examples:\n"
      "  source <(misalign completion bash)\n"
      "  misalign completion zsh > ~/.zfunc/_misalign");
  auto shell = std::make_shared<std::string>();
  verb.add_option("SHELL", *shell, "bash or zsh")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh"}));
  return [&app = *verb.get_parent(), shell] {
    put(*shell == "bash" ? bash_completion(app) : zsh_completion(app));
    return 0;
  };
}

}  // namespace misalign::search
