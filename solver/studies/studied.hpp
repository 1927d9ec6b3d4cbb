// What a study of a sheet comes to.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "solver/studies/option_fault.hpp"

namespace misalign::solver {

/// A number in a fault's sentence: by a format of printf.
inline std::string shown(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// What was found; or an option that does not fit the sheet; or neither where its path is lost, a
/// numerical failure.
template <class Study>
struct Studied {
  Studied() = default;
  Studied(Study found) : study(std::move(found)) {}
  Studied(OptionFault why_not) : fault(std::move(why_not)) {}

  std::optional<Study> study;
  std::optional<OptionFault> fault;
};

}  // namespace misalign::solver
