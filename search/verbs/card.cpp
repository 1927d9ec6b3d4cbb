// `misalign card`: the requirements of a design and the results of one sheet, on one page.
#include "search/sheets/card.hpp"

#include <fmt/format.h>

#include "schema/catalogue/study_table.hpp"
#include "schema/files/output_file.hpp"
#include "schema/kit/card_page.hpp"
#include "search/sheets/backlash.hpp"
#include "search/sheets/card_text.hpp"
#include "search/sheets/study_json.hpp"
#include "search/terminal/terminal.hpp"
#include "search/terminal/usable_threads.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct CardCall : SheetCall {
  schema::Design design;
  std::string material, hinge, output;
  CardOptions options;
  std::optional<int> jobs;
};

void show_card(CardCall call) {
  read_material(call.material, call.design);
  read_hinge(call.hinge, call.design);
  call.options.jobs = call.jobs.value_or(usable_threads());
  const Subject subject = choose_sheet(call.path, call.draw, call.design);
  const auto [card, springs] = card_of(subject, call.options);
  if (!call.output.empty()) {
    schema::write_text_file(call.output, schema::card_page(card, subject.sheet, springs));
  }
  if (!call.json) return put(card_text(card));
  put_json(study_json(subject, card));
}

}  // namespace

Action card_verb(CLI::App& verb) {
  verb.description(schema::study_named("card").about);
  verb.footer(
      "Compares each requirement of the design with what the sheet reaches: D, a certificate and\n"
      "contact up to the angle of use (the design's from_deg, or D), panel thickness, energy and\n"
      "static margins, pin friction, strokes and forces of springs, panel stress, landing speed,\n"
      "yield of miscut copies, joint clearance. Only what the design names is required: a\n"
      "thickness, friction, a stroke limit, a cutting error ...; \"wanted\" sets the margins.\n"
      "--output also writes a page to print, with a drawing, the springs to buy and the hinges.\n"
      "Examples:\n  misalign card mine.db 1234 --output card.html\n"
      "  misalign card search/patterns/table1.json --from 90 --thickness 1 --friction 0.0001");
  auto call = std::make_shared<CardCall>();
  schema::Design& design = call->design;
  add_sheet(verb, *call);
  add_from(verb, design.from_deg);
  add_springs(verb, design);
  add_fill(verb, design);
  add_thickness(verb, design.thickness_mm);
  const auto number = [&](const char* name, std::optional<double>& value, const char* meaning,
                          const char* key, const char* unit) {
    add_value(verb, name, value, std::string(meaning) + " [the design's]", within(key), unit);
  };
  number("--friction", design.friction_n_mm_per_mm, "dry friction of creases, N mm/mm",
         "hinges.friction_n_mm_per_mm", "N");
  number("--pin-friction", design.pin_friction_mm,
         "friction coefficient times radius of pins and ball joints, mm", "hinges.pin_friction_mm",
         "MM");
  number("--miscut", design.miscut_mm, "largest cutting error of a vertex, mm", "miscut_mm", "MM");
  number("--play", design.play_mm, "radius of the ball in which each joint settles, mm", "play_mm",
         "MM");
  add_material(verb, call->material);
  add_hinge(verb, call->hinge);
  add_default(verb, "--trials", call->options.trials,
              "number of miscut copies, and of settlings of loose joints",
              counted("card", "trials"), "N");
  add_value(verb, "--jobs", call->jobs, "threads; the answer does not depend on them [all cores]",
            counted("", "jobs"), "N");
  verb.add_option("--output", call->output, "HTML file to write")->type_name("FILE");
  verb.add_flag("--json", call->json, "as JSON");
  return showing(call, show_card);
}

}  // namespace misalign::search
