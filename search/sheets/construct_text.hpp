// A constructed sheet, as text.
#pragma once

#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "solver/optimise/construct.hpp"

namespace misalign::search {

/// What the theorem of parallel redrawing says of this sheet, then a line a hole.
std::string construct_text(const schema::Pattern& base, const solver::ConstructStudy& study,
                           double at_deg);

/// The sheet of the parallel family of a base read from `path`, shifting its inner vertices alone
/// or
/// (`rim`) all. UserError: 2 an option that does not fit, 3 a base without the family, or whose
/// holes leave another number of degrees of freedom than one.
solver::ConstructStudy constructed(const schema::Pattern& base, const std::string& path, bool rim,
                                   const solver::ConstructOptions& options);

}  // namespace misalign::search
