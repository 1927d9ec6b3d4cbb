#include "schema/print/printed_kit.hpp"

#include "schema/files/user_error.hpp"
#include "schema/kit/kit_bores.hpp"
#include "schema/print/printed_plate.hpp"

namespace misalign::schema {

std::vector<Solid> printed_kit(const solver::Sheet& sheet, const KitOptions& options) {
  if (!options.plates || !has_axes_within(options.crease)) {
    throw UserError(
        solver::OptionFault{"crease", crease_name(options.crease), "is no hinge of printed plates",
                            "take film, bevel or pin, and give " + parameter("thickness_mm")});
  }
  const KitFittings fittings = kit_fittings(sheet, options);
  std::vector<Solid> solids;
  for (const int facet : sheet.panels().facets) {
    solids.push_back(printed_plate(sheet, facet, fittings, options));
  }
  return solids;
}

}  // namespace misalign::schema
