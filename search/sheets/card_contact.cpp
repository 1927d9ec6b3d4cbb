#include "search/sheets/card_contact.hpp"

#include <fmt/format.h>

#include "search/sheets/studies.hpp"
#include "search/sheets/study_texts.hpp"

namespace misalign::search {
namespace {

using schema::CardLine;

// Springs without a diameter are judged by a usual one, where they are not too short for it.
solver::ContactStudy contact_with_springs(const solver::Sheet& sheet, schema::Design design) {
  if (!design.diameter_mm) {
    design.diameter_mm = solver::kSpringDiameter_mm;
    auto study = solver::contact(sheet, contact_options(design, {}, {}));
    if (study) return *std::move(study);
    design.diameter_mm.reset();
  }
  return contact_of(sheet, contact_options(design, {}, {}));
}

}  // namespace

std::vector<CardLine> contact_lines(const CardSheet& on) {
  schema::Design used = on.design;
  used.from_deg = on.used_deg;
  const solver::ContactStudy contact = contact_with_springs(on.sheet, used);
  const double first_deg = contact.first ? contact.first->pilot_deg : contact.known_until_deg;
  const bool is_reached = contact.reach_deg >= contact.used_from_deg;
  std::optional<double> thickness_mm;
  if (contact.thickness) thickness_mm = is_reached ? contact.thickness->thickness_mm : 0;
  CardLines lines;
  lines.ask("first_contact_deg", "First panel contact", "deg", on.used_deg, first_deg);
  lines.ask(
      "thickness_mm",
      fmt::format("Maximum panel thickness, tapered, corners trimmed by {:g} mm", contact.trim_mm),
      "mm", on.design.thickness_mm, thickness_mm);
  const solver::SpringMeeting* const met =
      contact.springs ? closest_meeting(*contact.springs) : nullptr;
  if (met != nullptr) {
    lines.ask(
        "spring_clearance_mm",
        fmt::format("Spring clearance, springs of {:g} mm", contact.springs->bodies.diameter_mm),
        "mm", 0, met->clear_mm, CardLine::Bound::at_least,
        spring_clearance_note(on.chosen.base, on.sheet.panels(), *contact.springs));
  }
  return lines.take();
}

}  // namespace misalign::search
