// Writes the study of contact as JSON: first contact, clearances, largest thickness.
#pragma once

#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "solver/contact/contact.hpp"

namespace misalign::schema {

/// "panels [2,3] and [4,3]", with their common vertex or crease.
std::string panels_text(const Pattern& base, const solver::Panels& panels,
                        const solver::PanelPair& pair);

/// {"pilot_deg", "kind", "panels", "joint", "on_panels_mm"}: the points of contact, on the flat
/// sheet.
Json contact_json(const Pattern& base, const solver::Panels& panels,
                  const solver::Contact& contact);

/// The study; clearances as arrays.
Json contact_study_json(const Pattern& base, const solver::Panels& panels,
                        const solver::ContactStudy& study);

}  // namespace misalign::schema
