#include "search/verbs/choice_options.hpp"

#include <limits>

#include "search/terminal/shell_word.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

CLI::Validator a_condition() {
  return CLI::Validator(
      [](const std::string& text) {
        return text.empty() ? "the condition is empty" : std::string();
      },
      "");
}

}  // namespace

ChoiceOptions add_choice(CLI::App& verb, CLI::App& group, Choice& choice) {
  ChoiceOptions options{};
  options.best = add_value(group, "--best", choice.best, "the best K candidates",
                           counted(1, std::numeric_limits<std::int64_t>::max()), "K");
  options.diverse =
      group
          .add_option("--diverse", choice.diverse,
                      "the K most different among the best " + std::to_string(kDiverseAmong))
          ->check(counted(1, std::numeric_limits<std::int64_t>::max()))
          ->excludes(options.best)
          ->type_name("K");
  options.where = group
                      .add_option("--where", choice.where,
                                  "only candidates that satisfy this SQL condition on columns and "
                                  "functions of sheets (misalign query --help)")
                      ->type_name("SQL")
                      ->check(a_condition());
  options.by = verb.add_option("--by", choice.by,
                               "column or function of a sheet by which the best are sorted, "
                               "largest first [as query `best` does]")
                   ->type_name("COLUMN");
  return options;
}

void check_by(const Choice& choice) {
  if (!choice.by || choice.best || choice.diverse) return;
  throw schema::UserError(
      schema::Cause::bad_request,
      "--by has no meaning without --best or --diverse; take it out, or add one of them");
}

}  // namespace misalign::search
