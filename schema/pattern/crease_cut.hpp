// Names the ways to make a crease in a kit.
#pragma once

#include <optional>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Making of a crease in a kit.
enum class CreaseCut {
  cut,    ///< every panel is a separate part, hinged by tape or textile
  score,  ///< a line
  dash,   ///< a perforation: cuts with bridges between
};
struct CreaseCutName {
  const char* name;
  CreaseCut cut;
};
inline constexpr CreaseCutName kCreaseCuts[] = {
    {"cut", CreaseCut::cut}, {"score", CreaseCut::score}, {"dash", CreaseCut::dash}};

/// Reads a key that holds such a name; null and wrong names, which are faults, leave `crease`.
void read_crease(ObjectReader& reader, const char* key, std::optional<CreaseCut>& crease);

/// Returns the name; null for none.
Json crease_json(const std::optional<CreaseCut>& crease);

}  // namespace misalign::schema
