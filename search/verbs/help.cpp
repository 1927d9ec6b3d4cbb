// `misalign help`: what another verb does.
#include "search/terminal/terminal.hpp"
#include "search/verbs/help_format.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {

Action help_verb(CLI::App& verb) {
  const CLI::App& app = *verb.get_parent();
  verb.description("what a verb does, with its options and examples");
  verb.footer("The same as misalign VERB --help.\n\nExamples:\n  misalign help search");
  std::vector<std::string> known;
  for (const CLI::App* each : verbs_of(app)) known.push_back(each->get_name());
  auto name = std::make_shared<std::string>();
  verb.add_option("VERB", *name, "the verb [all of them, a line each]")
      ->check(known_word("verb", known));
  return [&app, name] {
    const CLI::App& asked = name->empty() ? app : *app.get_subcommand(*name);
    // Not app.help(): that is this verb's, which was chosen.
    const std::string text =
        asked.get_formatter()->make_help(&asked, "", CLI::AppFormatMode::Normal);
    put(text);
    return 0;
  };
}

}  // namespace misalign::search
