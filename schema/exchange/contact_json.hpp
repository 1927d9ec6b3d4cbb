// The study of contact as JSON: where panels meet, and how thick they may be.
#pragma once

#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "solver/contact/contact.hpp"

namespace misalign::schema {

/// "panels [2,3] and [4,3]", with what they have in common.
std::string panels_text(const Pattern& base, const solver::Panels& panels,
                        const solver::PanelPair& pair);

/// {"pilot_deg", "kind", "panels", "joint", "on_panels_mm"}: where on either panel, on the flat
/// sheet.
Json contact_json(const Pattern& base, const solver::Panels& panels,
                  const solver::Contact& contact);

/// All of it; clearances as arrays.
Json contact_study_json(const Pattern& base, const solver::Panels& panels,
                        const solver::ContactStudy& study);

}  // namespace misalign::schema
