// `misalign design`: from wishes, and what is free, to designs that meet them.
#include <spdlog/spdlog.h>

#include <filesystem>

#include "schema/files/features.hpp"
#include "schema/files/json_values.hpp"
#include "schema/files/output_file.hpp"
#include "schema/kit/card_page.hpp"
#include "search/designs/design_text.hpp"
#include "search/designs/designer.hpp"
#include "search/sheets/card.hpp"
#include "search/sheets/card_remedies.hpp"
#include "search/sheets/card_text.hpp"
#include "search/sheets/export_files.hpp"
#include "search/terminal/terminal.hpp"
#include "search/terminal/usable_threads.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/kit_options.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/rank_options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

constexpr double kMostDraws = 1e12, kMostSeed = 9e18;

struct DesignCall {
  std::string path, directory;
  DesignerOptions options;
  bool json = false;
};

std::string path_in(const DesignCall& call, const char* name) {
  return (std::filesystem::path(call.directory) / name).string();
}

// Parts to cut; where they have no room for their fittings the reason is a warning.
void write_kit(const DesignCall& call, const Subject& subject) {
  ExportOptions files;
  files.read_from = call.path;
  files.directory = call.directory;
  files.format = has("dxflib") ? ExportFormat::dxf : ExportFormat::svg;
  files.warn = [](const std::string& words) { spdlog::warn("{}", words); };
  KitCall kit;
  kit.wanted = true;
  kit.options.test_piece = true;
  try {
    files.kit = chosen_kit(kit, subject.model.design());
    ExportFiles(subject.model, files)
        .write(subject.sheet, {"best", "misalign: " + subject.sheet.name()},
               schema::Json::object());
  } catch (const schema::UserError& error) {
    if (error.cause() == schema::Cause::failure) throw;
    spdlog::warn("no kit is written: {}", error.what());
  }
}

// The card of the best design, with remedies where it fails; its files.
schema::Card finish(const DesignCall& call, const DesignTry& best) {
  const Subject subject(sheet_of_made_pattern(best.pattern, best.how), {});
  const CardOptions options{call.options.trials, call.options.jobs, Advice::with};
  StudiedCard studied = card_of(subject, options);
  if (!call.directory.empty()) {
    const std::string path = path_in(call, "best.json");
    if (!studied.card.passes()) {
      studied.card.remedies = remedies_of(subject, studied, options, path);
    }
    schema::write_text_file(path, best.pattern.dump(1) + "\n");
    schema::write_text_file(
        path_in(call, "best-card.html"),
        schema::card_page(studied.card, subject.sheet, filling_in_use(card_sheet(subject))));
    write_kit(call, subject);
  }
  return std::move(studied.card);
}

int show_designs(DesignCall& call) {
  const schema::Wish wish = schema::read_wish(call.path);
  call.options.jobs = usable_threads();
  if (!call.directory.empty()) {
    make_directory(call.directory);
    call.options.log_path = path_in(call, "tried.json");
  }
  const std::vector<DesignTry> tries = designs_for(wish, call.options);
  std::optional<schema::Card> card;
  if (!tries.empty() && !tries.front().pattern.is_null()) card = finish(call, tries.front());
  if (call.json) {
    schema::Json json = {{"tries", schema::json_list(tries, design_try_json)}, {"card", nullptr}};
    if (card) json["card"] = schema::card_json(*card);
    put_json(json);
  } else {
    put(designs_text(call.path, tries));
    if (card) put("\n" + card_text(*card));
  }
  return card && card->passes() ? 0 : exit_code_of(schema::Cause::check_failed);
}

}  // namespace

Action design_verb(CLI::App& verb) {
  verb.description("designs that meet a file's requirements, from what is free in it");
  verb.footer(
      "WISH is a pattern file: its \"design\" holds the requirements and what is given, as for\n"
      "`misalign card`, and its \"free\" what may be chosen:\n"
      "  \"free\": { \"amplitude_mm\": [0.4, 8], \"thickness_mm\": [1.5, 3],\n"
      "            \"stiffness_n_per_mm\": {\"of\": [0.5, 1, 2]}, \"preload_n\": [0, 10],\n"
      "            \"from_deg\": [90, 150], \"holes\": [\"checkerboard-odd\", [[1, 1], [3, 3]]],\n"
      "            \"rim\": true, \"hold_flat\": true, \"one_a_hole\": true }\n"
      "Any number of a design but its requirements (`misalign config --keys`) can be free: two\n"
      "bounds, or a list as \"of\". Sheets are constructed for each angle of use, drawn at "
      "random,\n"
      "and climbed to where draws find none; with a \"target\" one is shaped to it instead, and\n"
      "shifts have no bounds. Then the free numbers are searched so that the least reserve of\n"
      "all requirements is largest, and the best sheets without a target are optimised towards\n"
      "the requirement that decides. Exit code 6: no design meets all of them; the nearest is\n"
      "shown.\n"
      "--output writes the best design (best.json, best-card.html with what would meet a\n"
      "requirement that fails, and a kit to cut with its guide), and tried.json, from which a\n"
      "stopped run goes on.\n"
      "Examples:\n  misalign design wish.json --output made\n"
      "  misalign design wish.json --draws 2000000 --json");
  auto call = std::make_shared<DesignCall>();
  verb.add_option("WISH", call->path, "pattern file (JSON) with \"design\" and \"free\"")
      ->required();
  verb.add_option("--output", call->directory, "folder of the files")->type_name("FOLDER");
  add_default(verb, "--draws", call->options.sources.draws,
              "largest number of draws of each base; 0: none", within(0, kMostDraws), "N");
  add_default(verb, "--seed", call->options.sources.seed, "seed of the draws", within(1, kMostSeed),
              "N");
  add_default(verb, "--trials", call->options.trials,
              "number of miscut copies, and of settlings of loose joints",
              counted("card", "trials"), "N");
  add_jobs(verb);
  verb.add_flag("--json", call->json, "as JSON");
  return [call] { return show_designs(*call); };
}

}  // namespace misalign::search
