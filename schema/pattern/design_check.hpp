// Whether a design names what its sheet has.
#pragma once

#include <string>

#include "schema/pattern/design.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::schema {

/// UserError (bad_input) about `source`: a preload of no diagonal, a hold that is no panel.
void check_names(const Design& design, const solver::PerforatedSheet& base,
                 const std::string& source);

}  // namespace misalign::schema
