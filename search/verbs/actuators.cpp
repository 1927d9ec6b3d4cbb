// `misalign actuators`: springs on the diagonals of one sheet.
#include <fmt/format.h>

#include <utility>

#include "schema/catalogue/study_table.hpp"
#include "schema/exchange/rubber_json.hpp"
#include "schema/pattern/parameters.hpp"
#include "search/sheets/studies.hpp"
#include "search/sheets/study_json.hpp"
#include "search/sheets/study_texts.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/purchase.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct ActuatorsCall : SheetCall {
  schema::Design design;
  bool chooses = false;
  SpringChoiceInput choice;
  std::vector<const CLI::Option*> of_springs;  // limits of --choose
  const CLI::Option* friction = nullptr;
  PurchaseCall purchase;
};

void refuse_limits_of_springs(const ActuatorsCall& call) {
  for (const CLI::Option* option : call.of_springs) {
    if (option->count() == 0) continue;
    throw schema::UserError(schema::Cause::bad_request,
                            option->get_name() +
                                ": is a limit of chosen springs, and this sheet's holes have "
                                "rubber plates; take it out");
  }
}

void refuse_idle_friction(const ActuatorsCall& call) {
  if (call.chooses || call.purchase.wanted || call.friction->count() == 0) return;
  throw schema::UserError(schema::Cause::bad_request,
                          "--friction: is overcome by springs that are chosen, and none are; add "
                          "--choose or --buy");
}

void show_actuators(const ActuatorsCall& call) {
  refuse_idle_friction(call);
  const Subject subject = choose_sheet(call.path, call.draw, call.design);
  const auto& [chosen, model, sheet] = subject;
  if (call.purchase.wanted) return show_purchase(call.purchase, subject, call.json);
  schema::Design design = model.design();
  const solver::Fill fill = design.fill(sheet.base());
  const auto* const plates = std::get_if<solver::RubberPlates>(&fill);
  if (call.chooses && !plates) {
    const solver::SpringChoice choice = chosen_springs(sheet, design, call.choice);
    if (call.json) return put_json(study_json(subject, choice));
    put("{}: ", sheet.name());
    return put(spring_choice_text(sheet, choice));
  }
  std::optional<solver::CutOutChoice> choice;
  if (call.chooses) {
    refuse_limits_of_springs(call);
    choice = chosen_cut_outs(sheet, *plates, design.from_deg);
    static_cast<schema::DesignFill&>(design) = schema::design_of(choice->plates, sheet.base());
  }
  const solver::Actuation actuation = actuated(sheet, design);
  if (call.json) {
    schema::Json json = study_json(subject, actuation);
    if (choice) json["choice"] = schema::choice_json(*choice);
    return put_json(json);
  }
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
  if (choice) put(cut_outs_text(sheet, *choice));
  put(actuators_text(sheet, actuation));
}

void add_choice(CLI::App& verb, ActuatorsCall& call) {
  const schema::DesignLimits free = schema::parameter_limits("actuators", "free_within"),
                             equal = schema::parameter_limits("actuators", "equal_lengths_share");
  solver::SpringChoiceOptions& options = call.choice.options;
  auto* const choose = verb.add_flag(
      "--choose", call.chooses,
      "choose springs: rates and free lengths that overcome the most friction at every angle, "
      "whatever the design's (also with --fill '{\"kind\": \"none\"}'); of rubber plates the "
      "cut-outs");
  for (const char* const of_equal_springs : {"--stiffness", "--preload", "--stroke-limit"}) {
    choose->excludes(of_equal_springs);
  }
  add_default(verb, "--most-rate", options.most_rate_n_per_mm, "largest rate of a spring, N/mm",
              within("actuators", "most_rate_n_per_mm"), "N_PER_MM")
      ->needs(choose);
  add_value(verb, "--rates", options.rates_n_per_mm, "rates to choose from, N/mm [any]",
            within("actuators", "rates_n_per_mm"), "LIST")
      ->delimiter(',')
      ->needs(choose);
  add_default(verb, "--free-within", options.free_within,
              "largest difference of a free length from flat", a_share(free.least, free.most),
              "SHARE")
      ->needs(choose);
  verb.add_flag("--pull-only", options.pull_only, "every spring pulls at every angle")
      ->needs(choose);
  verb.add_flag("--one-a-hole", options.one_a_hole, "at most one spring in each hole")
      ->needs(choose);
  verb.add_option("--never-both", call.choice.never_both,
                  "two diagonals that do not both carry springs: A3-A9,A4-A8 (may be repeated)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("DIAGONAL,DIAGONAL")
      ->needs(choose);
  add_value(verb, "--most-springs", options.most_springs, "largest number of springs",
            counted("actuators", "most_springs"), "N")
      ->needs(choose);
  call.friction = add_value(
      verb, "--friction", call.design.friction_n_mm_per_mm,
      "dry friction of creases that chosen springs overcome, N mm/mm [the design's, or 0]",
      within("hinges.friction_n_mm_per_mm"), "N");
  add_value(verb, "--fewest", options.fewest_margin,
            "as few springs as have this static margin over the friction",
            within("actuators", "fewest_margin"), "MARGIN")
      ->needs(choose);
  add_value(verb, "--equal-lengths", options.equal_lengths_share,
            "equal free lengths where this share of the friction overcome remains",
            a_share(equal.least, equal.most), "SHARE")
      ->needs(choose);
  for (const CLI::Option* const option : std::as_const(verb).get_options()) {
    const bool is_limit = option->get_needs().contains(choose) || option == call.friction;
    if (is_limit) call.of_springs.push_back(option);
  }
}

}  // namespace

Action actuators_verb(CLI::App& verb) {
  verb.description(schema::study_named("actuators").about);
  verb.footer(
      "Along the path:\n"
      "  energy       strain energy of the filling\n"
      "  moment       about the pilot crease, dE/d(pilot angle); negative: springs fold it on\n"
      "  advantage    mechanical advantage: force on the sheet's span per force in every diagonal\n"
      "  deployment   (180 - pilot)/180: 1 when flat\n"
      "Above: the least moment, and the fewest diagonals that keep half of it. Below: the force\n"
      "on each diagonal at D, or at --from. Forces and elongations are positive where a spring is\n"
      "longer than when flat, and pulls.\n"
      "Examples:\n  misalign actuators results/miura-6x6-1a2b3c4d.db 1234\n"
      "  misalign actuators results/miura-6x6-1a2b3c4d.db 1234 --from 140 --stroke-limit 0.08\n"
      "  misalign actuators search/patterns/table1.json\n"
      "  misalign actuators search/patterns/table1.json --choose --most-rate 1 --one-a-hole\n"
      "  misalign actuators search/patterns/table1.json --buy --from 120 --friction 0.000002");
  auto call = std::make_shared<ActuatorsCall>();
  add_sheet(verb, *call);
  add_from(verb, call->design.from_deg);
  add_springs(verb, call->design);
  add_fill(verb, call->design);
  add_choice(verb, *call);
  add_purchase(verb, call->purchase, call->design);
  verb.add_flag("--json", call->json, "as JSON, with all histories");
  return showing(call, show_actuators);
}

}  // namespace misalign::search
