#include "schema/catalogue/finding.hpp"

#include "schema/files/printable.hpp"

namespace misalign::schema {

Finding differs(const std::string& where, const std::string& column, const Json& stored,
                const Json& recomputed) {
  const auto shown = [](const Json& value) { return shortened(value.dump(), 200); };
  return {where + ": " + column + " is " + shown(stored) + " as stored, " + shown(recomputed) +
              " recomputed",
          {{"where", where}, {"column", column}, {"stored", stored}, {"recomputed", recomputed}}};
}

}  // namespace misalign::schema
