// `misalign deploy`: the deployment of one released sheet.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/catalogue/study_table.hpp"
#include "search/sheets/deploy_text.hpp"
#include "search/sheets/sheet_said.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/deploy_options.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

enum class Forces { in_motion, held };

struct DeployCall {
  std::string path;                   // a catalogue or a pattern file
  std::optional<std::uint64_t> draw;  // of a catalogue's campaign, accepted or not
  DeployInput input;
  std::optional<Forces> forces;
  bool json = false;
};

void show_deployment(const DeployCall& call) {
  const Subject subject = choose_sheet(call.path, call.draw, call.input.design);
  const auto& [chosen, model, sheet] = subject;
  solver::DeployOptions options = call.input.of(sheet, chosen.design);
  if (call.forces) options.forces = {.in_motion = *call.forces == Forces::in_motion};
  if (call.json) {
    const schema::Json json = deploy_said(subject, options);
    warn_beyond_d(sheet, options.from_deg);
    return put_json(json);
  }
  const solver::DeploymentStudy study = deployed(sheet, options);
  warn_beyond_d(sheet, options.from_deg);
  put("{}: deploys from {:g} deg\n", sheet.name(), sheet.deploys_from_deg());
  put(deployment_text(sheet.mechanism(), study));
}

}  // namespace

Action deploy_verb(CLI::App& verb) {
  verb.description(schema::study_named("deploy").about);
  verb.footer(
      "The exact motion of rigid panels with springs on all diagonals, let go at rest. It ends\n"
      "flat, or (outcome)\n"
      "  passed_flat   it goes through flat: with --latch it is latched\n"
      "  stalled       friction holds it on the way\n"
      "  at_rest       it comes to rest where springs are relaxed (--rest-deg)\n"
      "  turned_back   it turns round and nothing slows it down\n"
      "  fold_limit    it folds as far as it can\n"
      "  time_limit    it still moves\n"
      "Critical friction: the most that the creases may have for it to get to flat; with damping "
      "found\n"
      "by letting it go again and again, otherwise from its energies.\n"
      "Forces act on the panel right of a crease (seen walking along its name), or on the\n"
      "second of a ball joint; moments are about the crease's midpoint, square to it.\n"
      "Needs a program built with SUNDIALS (misalign --version).\n\n"
      "Examples:\n  misalign deploy search/patterns/table1.json\n"
      "  misalign deploy results/miura-6x6-1a2b3c4d.db 1234 --friction 0.001\n"
      "  misalign deploy search/patterns/table1.json --rest-deg 60 --from 120 --damping 0.05");
  auto call = std::make_shared<DeployCall>();
  add_catalogue_or_pattern(verb, call->path);
  add_draw_of_catalogue(verb, call->draw);
  add_deployment(verb, call->input);
  verb.add_option("--forces", call->forces,
                  "also what hinges and ball joints carry: in the motion, or with the sheet held "
                  "at each angle by its pilot crease [none]")
      ->transform(one_of<Forces>({{"motion", Forces::in_motion}, {"held", Forces::held}}));
  verb.add_flag("--json", call->json, "as JSON, with the whole motion");
  return [call] {
    show_deployment(*call);
    return 0;
  };
}

}  // namespace misalign::search
