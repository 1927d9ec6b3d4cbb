// `misalign card`: the requirements of a design and the results of one sheet, on one page.
#include "search/sheets/card.hpp"

#include <fmt/format.h>

#include "schema/catalogue/study_table.hpp"
#include "schema/files/output_file.hpp"
#include "schema/kit/card_page.hpp"
#include "search/sheets/backlash.hpp"
#include "search/sheets/card_remedies.hpp"
#include "search/sheets/card_text.hpp"
#include "search/sheets/study_json.hpp"
#include "search/terminal/terminal.hpp"
#include "search/terminal/usable_threads.hpp"
#include "search/verbs/border.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/rank_options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct CardCall : SheetCall {
  schema::Design design;
  std::string material, hinge, output;
  CardOptions options;
  bool without_remedies = false;
};

int show_card(CardCall call) {
  read_material(call.material, call.design);
  read_hinge(call.hinge, call.design);
  call.options.jobs = usable_threads();
  const Subject subject = choose_sheet(call.path, call.draw, call.design);
  StudiedCard studied = card_of(subject, call.options);
  schema::Card& card = studied.card;
  if (!call.without_remedies && !card.passes()) {
    card.remedies = remedies_of(subject, studied, call.options, call.path);
  }
  if (!call.output.empty()) {
    schema::write_text_file(
        call.output, schema::card_page(card, subject.sheet, filling_in_use(card_sheet(subject))));
  }
  if (call.json) {
    put_json(study_json(subject, card));
  } else {
    put(card_text(card));
  }
  return card.passes() ? 0 : exit_code_of(schema::Cause::check_failed);
}

}  // namespace

Action card_verb(CLI::App& verb) {
  verb.description(schema::study_named("card").about);
  verb.footer(
      "Compares each requirement with what the sheet reaches. Required of every sheet, up to the\n"
      "angle of use (the design's from_deg, or D): that it deploys, a certificate, no contact of\n"
      "panels, springs that do not touch, strokes above the cutting error, panels that do not\n"
      "buckle, and a preload that does not push it out of flat, unless \"hold_flat\" says that a\n"
      "stop, latch or frame holds it there. Required where the design names them: thickness,\n"
      "margins over friction, pins that do not lock, strokes and forces of springs, stress, "
      "landing\n"
      "speed, yield, joint clearance; \"wanted\" sets the margins.\n"
      "Exit code 6: a requirement is not met. Below it stand up to three single changes that "
      "would\n"
      "meet it and break no other, the smallest first, each checked by a card of its own; --json\n"
      "has their pattern files.\n"
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
  add_joints(verb, design);
  add_material(verb, call->material);
  add_hinge(verb, call->hinge);
  add_default(verb, "--trials", call->options.trials,
              "number of miscut copies, and of settlings of loose joints",
              counted("card", "trials"), "N");
  add_jobs(verb);
  add_hold_flat(verb, design.hold_flat);
  verb.add_flag("--no-remedies", call->without_remedies,
                "seek no change that would meet a requirement which fails");
  verb.add_option("--output", call->output, "HTML file to write")->type_name("FILE");
  verb.add_flag("--json", call->json, "as JSON");
  return [call] { return show_card(*call); };
}

}  // namespace misalign::search
