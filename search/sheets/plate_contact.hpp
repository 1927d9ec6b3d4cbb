// Checks that a sheet folds with plates of a thickness.
#pragma once

#include "schema/kit/kit_options.hpp"
#include "solver/contact/contact.hpp"

namespace misalign::search {

/// The contact of plates. UserError (bad_request) if they are thicker than the sheet can have up to
/// its angle of use.
solver::ContactStudy contact_of_plates(const solver::Sheet& sheet,
                                       const solver::ContactOptions& options, double thickness_mm);

/// A kit with the trim of its plates; none of those or of their barrels is too thick. UserError as
/// above.
schema::KitOptions trimmed_kit(const solver::Sheet& sheet, const schema::KitOptions& kit,
                               std::optional<double> trim_mm);

}  // namespace misalign::search
