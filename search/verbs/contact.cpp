// `misalign contact`: where the panels of one sheet meet, and how thick they may be.
#include <fmt/format.h>

#include "schema/catalogue/study_table.hpp"
#include "search/sheets/study_json.hpp"
#include "search/sheets/study_texts.hpp"
#include "search/terminal/terminal.hpp"
#include "search/verbs/options.hpp"
#include "search/verbs/verbs.hpp"

namespace misalign::search {
namespace {

struct ContactCall : SheetCall {
  schema::Design design;
  std::optional<double> trim_mm;
};

void show_contact(const ContactCall& call) {
  const Subject subject = choose_sheet(call.path, call.draw, call.design);
  const auto& [chosen, model, sheet] = subject;
  const solver::ContactStudy study = contact_of(sheet, {call.trim_mm, model.design().from_deg});
  if (call.json) return put_json(study_json(subject, study));
  put("{}: deploys from {:g} deg\n", sheet.name(), study.deploys_from_deg);
  put(contact_text(chosen.base, sheet.panels(), study));
}

}  // namespace

Action contact_verb(CLI::App& verb) {
  verb.description(schema::study_named("contact").about);
  verb.footer(
      "Of panels without thickness, at any angle and not only at samples: the first at which\n"
      "two meet. Those with a common crease meet when it is closed, those with one common\n"
      "vertex when a ray from it lies in both. Then the least distances on the way:\n"
      "  apart_mm     of panels without a common vertex\n"
      "  vertex_deg   of panels with one common vertex, as an angle seen from it\n"
      "  crease_deg   of the most folded crease from 180\n"
      "Thickness: hinges at the mid-plane; a plate is tapered towards each crease by the plane\n"
      "through it at which neighbours touch when most folded up to --from, and trimmed across "
      "each\n"
      "corner where it meets another panel in that point alone, as ball joints are (--trim).\n"
      "Plates as thick as is said clear each other up to there; thicker ones might.\n\n"
      "Examples:\n  misalign contact search/patterns/table1.json\n"
      "  misalign contact results/miura-6x6-1a2b3c4d.db 1234 --from 140 --trim 8\n"
      "  misalign contact results/miura-6x6-1a2b3c4d.db 1234 --json");
  auto call = std::make_shared<ContactCall>();
  add_sheet(verb, *call);
  add_from(verb, call->design.from_deg);
  add_trim(verb, call->trim_mm);
  verb.add_flag("--json", call->json, "as JSON");
  return showing(call, show_contact);
}

}  // namespace misalign::search
