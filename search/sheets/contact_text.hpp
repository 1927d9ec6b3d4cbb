// A study of contact, as text.
#pragma once

#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "solver/contact/contact.hpp"

namespace misalign::search {

/// Where panels first meet, how thick they may be, and the least distances every 10 degrees.
std::string contact_text(const schema::Pattern& base, const solver::Panels& panels,
                         const solver::ContactStudy& study);

}  // namespace misalign::search
