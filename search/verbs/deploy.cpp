// `misalign deploy`: the deployment of one released sheet.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/catalogue/study_table.hpp"
#include "search/sheets/study_json.hpp"
#include "search/sheets/study_texts.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/deploy_options.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

enum class Forces { in_motion, held };
enum class PanelKind { rigid, bend };

struct DeployCall : SheetCall {
  DeployInput input;
  std::optional<Forces> forces;
  std::optional<PanelKind> panels;  // none: they bend where a material is named
  std::string material, hinge;
};

void show_deployment(DeployCall call) {
  read_material(call.material, call.input.design);
  read_hinge(call.hinge, call.input.design);
  const Subject subject = choose_sheet(call.path, call.draw, call.input.design);
  const auto& [chosen, model, sheet] = subject;
  solver::ReleaseOptions options = call.input.of(sheet, chosen.design);
  if (call.forces) options.forces = {.in_motion = *call.forces == Forces::in_motion};
  const bool bends =
      call.panels ? *call.panels == PanelKind::bend : panels_bend(model.design(), sheet);
  const ReleasedSheet found = released_sheet(sheet, options, model.design(), bends);
  warn_beyond_d(sheet, options.from_deg);
  if (call.json) return put_json(study_json(subject, found));
  std::string text =
      fmt::format("{}: deploys from {:g} deg\n", sheet.name(), sheet.deploys_from_deg());
  if (found.bent) text += bent_panels_text(*found.bent, found.motion.friction);
  text += deployment_text(sheet.mechanism(), found.motion);
  if (found.pins) text += pins_text(*found.pins);
  put(text);
}

}  // namespace

Action deploy_verb(CLI::App& verb) {
  verb.description(schema::study_named("deploy").about);
  verb.footer(
      "Integrates the exact motion of rigid panels with springs on all diagonals, released at\n"
      "rest. It ends flat, or with another outcome:\n"
      "  passed_flat   it passes through flat; --latch latches it there\n"
      "  stalled       friction holds it on the way\n"
      "  at_rest       it comes to rest where springs are relaxed (--rest-deg)\n"
      "  turned_back   it turns round and nothing slows it down\n"
      "  fold_limit    it reaches its fold limit\n"
      "  time_limit    it still moves\n"
      "Critical friction: the largest crease friction with which the sheet reaches flat; with\n"
      "damping found by repeated integration, otherwise from energies.\n"
      "Forces act on the panel right of a crease (seen walking along its name), or on the\n"
      "second of a ball joint; moments are about the crease's midpoint, square to it.\n"
      "Bending panels (--panels bend, or where a material is named): each bends into a saddle\n"
      "between straight creases, in equilibrium with the springs at every angle. Their results\n"
      "come first; the others, and the motion, are those of rigid panels, an upper bound: a\n"
      "sudden release also shakes panels (`misalign stress`). The static margin is the driving\n"
      "moment over the resisting one, less 1, at its least from the start down to --margin-to.\n"
      "--preload leaves a force in the springs at flat, without which any friction stalls the\n"
      "sheet close to flat.\n"
      "Needs a program built with SUNDIALS (misalign --version).\n\n"
      "Examples:\n  misalign deploy search/patterns/table1.json\n"
      "  misalign deploy results/miura-6x6-1a2b3c4d.db 1234 --friction 0.001\n"
      "  misalign deploy search/patterns/table1.json --rest-deg 60 --from 120 --damping 0.05\n"
      "  misalign deploy search/patterns/table1.json --panels bend --thickness 4 --preload 3\n"
      "  misalign deploy search/patterns/table1.json --material acrylic --hinge \"glued textile\"");
  auto call = std::make_shared<DeployCall>();
  add_sheet(verb, *call);
  add_deployment(verb, call->input);
  verb.add_option(
          "--panels", call->panels,
          "rigid, or plates that bend [bend where the design or --material names a material]")
      ->transform(one_of<PanelKind>({{"rigid", PanelKind::rigid}, {"bend", PanelKind::bend}}));
  add_material(verb, call->material);
  add_hinge(verb, call->hinge);
  add_value(verb, "--margin-to", call->input.design.margin_to_deg,
            fmt::format("smallest angle at which margins of bending panels and pins count [the "
                        "design's, or {:g}]",
                        solver::BentPanelsOptions{}.to_deg),
            within("wanted.margin_to_deg"), "DEG");
  verb.add_option("--forces", call->forces,
                  "also forces in hinges and ball joints: in the motion, or with the sheet held at "
                  "each angle by its pilot crease [none]")
      ->transform(one_of<Forces>({{"motion", Forces::in_motion}, {"held", Forces::held}}));
  verb.add_flag("--json", call->json, "as JSON, with the whole motion");
  return showing(call, show_deployment);
}

}  // namespace misalign::search
