#include "search/sheets/plate_contact.hpp"

#include <fmt/format.h>

#include "search/sheets/studies.hpp"

namespace misalign::search {

namespace {

// A size that is limited to a share of the largest thickness.
struct PlateSize {
  const char *option, *name;
  double mm, share = 1;
};

solver::ContactStudy contact_within(const solver::Sheet& sheet,
                                    const solver::ContactOptions& options, const PlateSize& size) {
  solver::ContactStudy study = contact_of(sheet, options);
  const double largest_mm = size.share * (study.thickness ? study.thickness->thickness_mm : 0);
  if (size.mm <= largest_mm) return study;
  throw schema::UserError(solver::OptionFault{
      size.option, fmt::format("{:g}", size.mm),
      fmt::format("too thick (plates of {} fold to {} up to {} of {:.4g} mm, trimmed by {:g} mm)",
                  sheet.name(),
                  options.from_deg ? fmt::format("{:.10g} deg", study.used_from_deg) : "D",
                  size.name, largest_mm, study.trim_mm),
      "take thinner plates, or trim more by " + schema::parameter("trim_mm")});
}

}  // namespace

solver::ContactStudy contact_of_plates(const solver::Sheet& sheet,
                                       const solver::ContactOptions& options, double thickness_mm) {
  return contact_within(sheet, options, {"thickness_mm", "a thickness", thickness_mm});
}

schema::KitOptions trimmed_kit(const solver::Sheet& sheet, const schema::KitOptions& kit,
                               std::optional<double> trim_mm) {
  schema::KitOptions trimmed = kit;
  const bool folds = kit.from_deg || sheet.deploys_from_deg() > 0;  // PlateEdges refuses others
  if (!kit.plates || !schema::are_set_back(kit.crease) || !folds) return trimmed;
  const schema::PlateOptions& plates = *kit.plates;
  const solver::ContactOptions options = {trim_mm, kit.from_deg};
  solver::ContactStudy study;
  if (kit.crease == schema::CreaseCut::offset) {
    // They lie within plates of twice their height round the plane of the axes.
    study = contact_within(sheet, options,
                           {"thickness_mm", "a height, spacers included, above their films",
                            plates.spacer_mm + plates.thickness_mm, 0.5});
  } else if (kit.crease == schema::CreaseCut::pin && plates.barrel_mm > plates.thickness_mm) {
    study = contact_within(sheet, options, {"barrel_mm", "a thickness", plates.barrel_mm});
  } else {
    study = contact_of_plates(sheet, options, plates.thickness_mm);
  }
  trimmed.plates->trim_mm = study.trim_mm;
  if (trimmed.joints) trimmed.joints = trimmed.joints->between_plates(study.trim_mm);
  return trimmed;
}

}  // namespace misalign::search
