#include "schema/files/features.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/files/input.hpp"

namespace misalign::schema {
namespace {

const Feature& feature_of(std::string_view library) {
  return *std::find_if(std::begin(kFeatures), std::end(kFeatures),
                       [&](const Feature& feature) { return feature.library == library; });
}

}  // namespace

std::string missing_text(std::string_view library) {
  const Feature& feature = feature_of(library);
  return fmt::format(
      "{} needs {} (this program was built without it); install it (Debian: {}) and build the "
      "program again (search/manual/how-to/install.md)",
      feature.purpose, feature.library, feature.package);
}

void need(std::string_view library) {
  if (!feature_of(library).is_in) throw UserError(Cause::failure, missing_text(library));
}

std::string libraries_text(bool in) {
  std::string text;
  for (const Feature& feature : kFeatures) {
    if (feature.is_in == in) text += fmt::format("{}{}", text.empty() ? "" : ", ", feature.library);
  }
  return text.empty() ? "none" : text;
}

}  // namespace misalign::schema
