// `misalign config`: the default campaign, or every fault of a file.
#include <fmt/format.h>

#include "schema/campaign/campaign_file.hpp"
#include "schema/campaign/key_list.hpp"
#include "search/ranks/search_run.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct ConfigCall {
  bool show = false, keys = false;
  std::string checked;
};

void show_config(const ConfigCall& call) {
  if (call.show) {
    put_json(schema::campaign_json(schema::default_campaign()), 2);
  } else if (call.keys) {
    put(schema::campaign_keys_markdown());
  } else {
    const schema::Campaign campaign = schema::read_campaign_file(call.checked);
    say_reading(call.checked, campaign.pattern);
    put("{}: good; catalogue {}\n", schema::printable(call.checked),
        default_catalogue_path(campaign));
  }
}

}  // namespace

Action config_verb(CLI::App& verb) {
  verb.description("the default campaign, or every fault of a file");
  verb.footer(
      "Examples:\n  misalign config --default > mine.json\n"
      "  misalign config --check mine.json");
  auto call = std::make_shared<ConfigCall>();
  auto* choice = verb.add_option_group("choice", "what to do");
  choice->add_flag("--default", call->show, "print the default campaign with every key");
  choice->add_flag("--keys", call->keys, "print what each key means, as a Markdown table");
  choice->add_option("--check", call->checked, "list every fault of a campaign file")
      ->type_name("CAMPAIGN");
  choice->require_option(1);
  return showing(call, show_config);
}

}  // namespace misalign::search
