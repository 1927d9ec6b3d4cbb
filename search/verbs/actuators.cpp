// `misalign actuators`: springs on the diagonals of one sheet.
#include <fmt/format.h>

#include "schema/catalogue/study_table.hpp"
#include "search/sheets/study_json.hpp"
#include "search/sheets/study_texts.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct ActuatorsCall : SheetCall {
  schema::Design design;
};

void show_actuators(const ActuatorsCall& call) {
  const Subject subject = choose_sheet(call.path, call.draw, call.design);
  const auto& [chosen, model, sheet] = subject;
  const solver::Actuation actuation = actuated(sheet, model.design());
  if (call.json) return put_json(study_json(subject, actuation));
  const solver::Verdict& verdict = sheet.history().verdict;
  const double deploys_from_deg = sheet.sample_deg(verdict.deploys_from_sample);
  const char* decision = "";
  if (chosen.drawn) {
    const bool accepted = chosen.drawn->campaign.accepts(verdict);
    decision = accepted ? "accepted, " : "not accepted, ";
  }
  const bool is_undecided = verdict.first_fault == solver::Fault::undecided;
  put("{}: {}deploys from {:g} deg{}\n", sheet.name(), decision, deploys_from_deg,
      is_undecided ? " (undecided beyond that)" : "");
  put(actuators_text(sheet, actuation));
}

}  // namespace

Action actuators_verb(CLI::App& verb) {
  verb.description(schema::study_named("actuators").about);
  verb.footer(
      "Along the path:\n"
      "  energy       strain energy of all springs\n"
      "  moment       about the pilot crease, dE/d(pilot angle); negative: springs fold it on\n"
      "  advantage    mechanical advantage: force on the sheet's span per force in every diagonal\n"
      "  deployment   (180 - pilot)/180: 1 when flat\n"
      "Above: the least moment, and the fewest diagonals that keep half of it. Below: the force\n"
      "on each diagonal at D, or at --from. Forces and elongations are positive where a spring is\n"
      "longer than when flat, and pulls.\n"
      "Examples:\n  misalign actuators results/miura-6x6-1a2b3c4d.db 1234\n"
      "  misalign actuators results/miura-6x6-1a2b3c4d.db 1234 --from 140 --stroke-limit 0.08\n"
      "  misalign actuators search/patterns/table1.json");
  auto call = std::make_shared<ActuatorsCall>();
  add_sheet(verb, *call);
  add_from(verb, call->design.from_deg);
  add_springs(verb, call->design);
  verb.add_flag("--json", call->json, "as JSON, with all histories");
  return showing(call, show_actuators);
}

}  // namespace misalign::search
