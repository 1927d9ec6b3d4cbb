// Draws a kit to cut: the sheet's numbered parts, nested on sheets of material.
#pragma once

#include <string>
#include <vector>

#include "schema/kit/kit_layout.hpp"
#include "schema/kit/kit_parts.hpp"
#include "schema/kit/kit_springs.hpp"

namespace misalign::schema {

struct Kit {
  KitFittings fittings;
  std::vector<KitPart> parts;
  KitSheets sheets;                ///< a place for each part
  std::vector<KitSpring> springs;  ///< none without bores for springs
  std::vector<int> cuts;  ///< creases of the mechanism that are cut so that parts fit a bed
  std::string warning;    ///< names springs that contradict the verdict
};

/// UserError (bad_request) if the options do not go together, a panel does not fit the bed, bores
/// or tabs do not fit a panel, or the kerf is too wide.
Kit kit_of(const solver::Sheet& sheet, const KitOptions& options, const std::string& title);

/// The spacers of a kit of offset plates, with the bores of its plates: they lie on the films and
/// reach nearer to the creases. None without a thickness of spacers. UserError as above.
KitSheets kit_spacer_sheets(const solver::Sheet& sheet, const Kit& kit, const KitOptions& options,
                            const std::string& title);

}  // namespace misalign::schema
