// `misalign contact`: the first contact of a sheet's panels, and their maximum thickness.
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
  std::optional<double> trim_mm, end_mm;
  bool finds_faces = false;
};

void show_contact(const ContactCall& call) {
  const Subject subject = choose_sheet(call.path, call.draw, call.design);
  const auto& [chosen, model, sheet] = subject;
  const solver::ContactStudy study =
      contact_of(sheet, contact_options(model.design(), call.trim_mm, call.end_mm));
  std::optional<solver::SpringFaces> faces;
  if (call.finds_faces) faces = faces_of_springs(sheet, model.design(), call.end_mm);
  if (call.json) return put_json(study_json(subject, study, faces));
  put("{}: deploys from {:g} deg\n", sheet.name(), study.deploys_from_deg);
  put(contact_text(chosen.base, sheet.panels(), study));
  if (faces) put(spring_faces_table(sheet.mechanism(), *faces) + spring_faces_text(*faces));
}

}  // namespace

Action contact_verb(CLI::App& verb) {
  verb.description(schema::study_named("contact").about);
  verb.footer(
      "Finds the first contact of panels without thickness, at any angle and not only at samples.\n"
      "Panels with a common crease meet when it is closed, panels with one common vertex when a\n"
      "ray from it lies in both. The table has the least distances on the way:\n"
      "  apart_mm     of panels without a common vertex\n"
      "  vertex_deg   of panels with one common vertex, as an angle seen from it\n"
      "  crease_deg   of the most folded crease from 180\n"
      "Thickness: hinges lie in the mid-plane. A plate is tapered towards each crease by the\n"
      "plane through it at which neighbours touch when most folded up to --from. It is trimmed\n"
      "across each corner where it meets another panel in that point alone, as at ball joints\n"
      "(--trim).\n"
      "Plates of the thickness shown clear each other up to that angle; thicker ones might.\n"
      "Springs with a diameter (--diameter, or the design's) are round bodies between their ends,\n"
      "without --end mm at each end: at a common vertex they always meet. They are compared with\n"
      "each other and with plates of the design's thickness, from --from to flat, and not only at\n"
      "samples:\n"
      "  in_hole_mm, largest_mm  axes of the two springs of one hole, least and largest\n"
      "  springs_mm   axes of springs of different holes\n"
      "  panels_mm    axes from mid-planes\n"
      "--offset-ends hangs each spring on a face, in the mid-plane or in one of two layers above\n"
      "it, so that none meets another or a panel, and says if they still drive the sheet.\n"
      "Examples:\n  misalign contact search/patterns/table1.json\n"
      "  misalign contact results/miura-6x6-1a2b3c4d.db 1234 --from 140 --trim 8\n"
      "  misalign contact search/patterns/table1.json --diameter 5 --offset-ends\n"
      "  misalign contact results/miura-6x6-1a2b3c4d.db 1234 --json");
  auto call = std::make_shared<ContactCall>();
  add_sheet(verb, *call);
  add_from(verb, call->design.from_deg);
  add_trim(verb, call->trim_mm);
  add_value(verb, "--diameter", call->design.diameter_mm,
            "diameter of the springs, mm: which of them touch each other or panels [the design's, "
            "or springs are not judged]",
            within("springs.diameter_mm"), "MM");
  add_value(verb, "--end", call->end_mm,
            fmt::format("length left out at each end of a spring, mm [{:g} diameters]",
                        solver::kEndDiameters),
            within("contact", "end_mm"), "MM");
  verb.add_flag("--offset-ends", call->finds_faces,
                "also faces and layers of the springs in which none touch");
  verb.add_flag("--json", call->json, "as JSON");
  return showing(call, show_contact);
}

}  // namespace misalign::search
