// `misalign config`: the default campaign, every fault of a file, or the tables of materials and
// hinges.
#include <fmt/format.h>

#include "schema/campaign/campaign_file.hpp"
#include "schema/campaign/key_list.hpp"
#include "schema/pattern/hinge_table.hpp"
#include "schema/pattern/material_table.hpp"
#include "search/ranks/search_run.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct ConfigCall {
  bool show = false, keys = false, materials = false, json = false;
  std::string checked;
};

void show_materials(bool json) {
  if (json) {
    return put_json(
        {{"materials", schema::material_table_json()}, {"hinges", schema::hinge_table_json()}});
  }
  put("{}\n{}", schema::material_table_markdown(), schema::hinge_table_markdown());
}

void show_config(const ConfigCall& call) {
  if (call.show) {
    put_json(schema::campaign_json(schema::default_campaign()), 2);
  } else if (call.keys) {
    put(schema::campaign_keys_markdown());
  } else if (call.materials) {
    show_materials(call.json);
  } else {
    const schema::Campaign campaign = schema::read_campaign_file(call.checked);
    say_reading(call.checked, campaign.pattern);
    put("{}: good; catalogue {}\n", schema::printable(call.checked),
        default_catalogue_path(campaign));
  }
}

}  // namespace

Action config_verb(CLI::App& verb) {
  verb.description("the default campaign, every fault of a file, or materials and hinges");
  verb.footer(
      "Examples:\n  misalign config --default > mine.json\n"
      "  misalign config --check mine.json\n"
      "  misalign config --materials");
  auto call = std::make_shared<ConfigCall>();
  auto* choice = verb.add_option_group("choice", "what to do");
  choice->add_flag("--default", call->show, "print the default campaign with every key");
  choice->add_flag("--keys", call->keys, "print what each key means, as a Markdown table");
  auto* materials =
      choice->add_flag("--materials", call->materials,
                       "print the tables of materials and of hinges, with sources, in Markdown");
  choice->add_option("--check", call->checked, "list every fault of a campaign file")
      ->type_name("CAMPAIGN");
  choice->require_option(1);
  verb.add_flag("--json", call->json, "with --materials: as JSON")->needs(materials);
  return showing(call, show_config);
}

}  // namespace misalign::search
