#include "schema/print/printed_kit.hpp"

#include "schema/files/user_error.hpp"
#include "schema/kit/kit_bores.hpp"
#include "schema/print/ball_joints.hpp"
#include "schema/print/printed_plate.hpp"

namespace misalign::schema {

std::vector<Solid> printed_kit(const solver::Sheet& sheet, const KitOptions& options) {
  if (!options.plates || !are_set_back(options.crease) || options.crease == CreaseCut::offset) {
    throw UserError(
        solver::OptionFault{"crease", crease_name(options.crease), "is no hinge of printed plates",
                            "take film, bevel or pin, and give " + parameter("thickness_mm")});
  }
  const KitFittings fittings = kit_fittings(sheet, options);
  std::vector<Solid> solids;
  for (const int facet : sheet.panels().facets) {
    solids.push_back(printed_plate(sheet, facet, fittings, options));
  }
  if (options.joints && options.joints->kind == solver::JointKind::ball) {
    add_ball_joints(sheet, options, solids);
  }
  return solids;
}

}  // namespace misalign::schema
