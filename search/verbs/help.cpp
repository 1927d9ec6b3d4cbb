// `misalign help`: what another verb does, and where the manual is.
#include "schema/files/user_error.hpp"
#include "search/terminal/site.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/help_format.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

using schema::Cause;
using schema::UserError;

std::string first_page_of_site() {
  if (const auto folder = place_of_site()) return (*folder / "index.html").string();
  throw UserError(Cause::failure,
                  "the site is not beside this program (it is made on request); in the source "
                  "folder scripts/site.sh makes it, build/site/html/index.html");
}

}  // namespace

Action help_verb(CLI::App& verb) {
  const CLI::App& app = *verb.get_parent();
  verb.description("what a verb does, with its options and examples");
  verb.footer(
      "The same as misalign VERB --help.\n\n"
      "Examples:\n"
      "  misalign help search\n"
      "  xdg-open \"$(misalign help --site)\"");
  std::vector<std::string> known;
  for (const CLI::App* each : verbs_of(app)) known.push_back(each->get_name());
  auto name = std::make_shared<std::string>();
  auto* named = verb.add_option("VERB", *name, "the verb [all of them, a line each]")
                    ->check(known_word("verb", known));
  auto site = std::make_shared<bool>(false);
  verb.add_flag("--site", *site, "where the manual's first page is, for a browser")
      ->excludes(named);
  return [&app, name, site] {
    if (*site) {
      put(first_page_of_site() + "\n");
      return 0;
    }
    const CLI::App& asked = name->empty() ? app : *app.get_subcommand(*name);
    // Not app.help(): that is this verb's, which was chosen.
    const std::string text =
        asked.get_formatter()->make_help(&asked, "", CLI::AppFormatMode::Normal);
    put(text);
    return 0;
  };
}

}  // namespace misalign::search
