// Says how the springs of a mesh with a folded target hold it there.
#pragma once

#include <string>

#include "schema/exchange/folding_json.hpp"

namespace misalign::search {

/// Returns lines, each after a line break: the misfit of the target and how the filling holds the
/// sheet there. Empty without a target on the sheet's path.
std::string target_text(const schema::FoldingView& view, const solver::Fill& fill);

}  // namespace misalign::search
