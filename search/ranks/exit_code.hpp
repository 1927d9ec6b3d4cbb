// The exit code that a rank tells the others.
#pragma once

#include <spdlog/spdlog.h>

#include "search/terminal/failure.hpp"

namespace misalign::search {

/// The exit code of `work`, 0 if it throws nothing; what it throws is said.
template <class Work>
int exit_code_of(const Border& border, const Work& work) {
  try {
    work();
    return 0;
  } catch (const std::exception& error) {
    const schema::UserError failure = failure_of(error);
    spdlog::error("{}", failure.sentence(border.name_parameter));
    return border.exit_code(failure.cause());
  }
}

}  // namespace misalign::search
