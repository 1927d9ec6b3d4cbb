// `misalign help`: the options of a verb, and the path of the manual.
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
  verb.description("the options and examples of a verb");
  verb.footer(
      "The same as misalign VERB --help.\n\n"
      "Examples:\n"
      "  misalign help search\n"
      "  xdg-open \"$(misalign help --site)\"");
  std::vector<std::string> known;
  for (const CLI::App* each : verbs_of(app)) known.push_back(each->get_name());
  auto name = std::make_shared<std::string>();
  auto* named = verb.add_option("VERB", *name, "name of the verb [all of them, a line each]")
                    ->check(known_word("verb", known));
  auto site = std::make_shared<bool>(false);
  verb.add_flag("--site", *site, "path of the manual's first page, for a browser")->excludes(named);
  return [&app, name, site] {
    if (*site) {
      put(first_page_of_site() + "\n");
      return 0;
    }
    const CLI::App& explained = name->empty() ? app : *app.get_subcommand(*name);
    // app.help() would be the help of this verb, which was chosen.
    const std::string text =
        explained.get_formatter()->make_help(&explained, "", CLI::AppFormatMode::Normal);
    put(text);
    return 0;
  };
}

}  // namespace misalign::search
