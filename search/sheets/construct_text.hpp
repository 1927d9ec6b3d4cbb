// A constructed sheet, as text.
#pragma once

#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "solver/optimise/construct.hpp"

namespace misalign::search {

/// What the theorem of parallel redrawing says of this sheet, then a line a hole.
std::string construct_text(const schema::Pattern& base, const solver::ConstructStudy& study,
                           double at_deg);

}  // namespace misalign::search
