// Unwraps what a study found, and refuses where it found nothing.
#pragma once

#include <string>
#include <utility>

#include "schema/files/user_error.hpp"
#include "solver/studies/studied.hpp"

namespace misalign::search {

/// UserError: a bad request for an option that does not fit, a failure with this sentence where the
/// path is lost.
template <class Study>
Study found(solver::Studied<Study> studied, const std::string& lost) {
  if (studied.fault) throw schema::UserError(*studied.fault);
  if (!studied.study) throw schema::UserError(schema::Cause::failure, lost);
  return std::move(*studied.study);
}

}  // namespace misalign::search
