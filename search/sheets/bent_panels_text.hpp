// The study of panels that bend, in words.
#pragma once

#include <string>

#include "schema/exchange/bent_panels_json.hpp"

namespace misalign::search {

/// `rigid`: the same sheet with rigid panels, an upper bound.
std::string bent_panels_text(const schema::BentSheet& sheet, const solver::FrictionLimits& rigid);

}  // namespace misalign::search
