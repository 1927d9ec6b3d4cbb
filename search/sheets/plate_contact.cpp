#include "search/sheets/plate_contact.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "search/sheets/studies.hpp"

namespace misalign::search {

solver::ContactStudy contact_of_plates(const solver::Sheet& sheet,
                                       const solver::ContactOptions& options, double thickness_mm) {
  solver::ContactStudy study = contact_of(sheet, options);
  const double largest_mm = study.thickness ? study.thickness->thickness_mm : 0;
  if (thickness_mm <= largest_mm) return study;
  throw schema::UserError(solver::OptionFault{
      "thickness_mm", fmt::format("{:g}", thickness_mm),
      fmt::format("too thick (plates of {} fold to {} up to a thickness of {:.4g} mm, trimmed by "
                  "{:g} mm)",
                  sheet.name(),
                  options.from_deg ? fmt::format("{:.10g} deg", study.used_from_deg) : "D",
                  largest_mm, study.trim_mm),
      "take thinner plates, or trim more by " + schema::parameter("trim_mm")});
}

schema::KitOptions trimmed_kit(const solver::Sheet& sheet, const schema::KitOptions& kit,
                               std::optional<double> trim_mm) {
  schema::KitOptions trimmed = kit;
  if (!kit.plates || !schema::has_axes_within(kit.crease)) return trimmed;
  const double barrel_mm = kit.crease == schema::CreaseCut::pin ? kit.plates->barrel_mm : 0;
  trimmed.plates->trim_mm = contact_of_plates(sheet, {trim_mm, kit.plates->from_deg},
                                              std::max(kit.plates->thickness_mm, barrel_mm))
                                .trim_mm;
  if (trimmed.joints) trimmed.joints->parts.trim_mm = trimmed.plates->trim_mm;
  return trimmed;
}

}  // namespace misalign::search
