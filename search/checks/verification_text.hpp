// Results of `misalign verify` as text and as JSON.
#pragma once

#include <string>

#include "search/checks/verify.hpp"

namespace misalign::search {

std::string verification_text(const Verification& verification);
schema::Json verification_json(const Verification& verification);

}  // namespace misalign::search
