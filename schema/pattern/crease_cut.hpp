// Names the ways to make a crease in a kit.
#pragma once

#include <optional>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Making of a crease in a kit.
enum class CreaseCut {
  cut,     ///< every panel is a separate part, hinged by tape or textile
  score,   ///< a line
  dash,    ///< a perforation: cuts with bridges between
  film,    ///< plates with square edges, apart, and a film at half their thickness between them
  bevel,   ///< plates with bevelled edges that meet in the crease at half their thickness
  pin,     ///< plates apart for a pin and its barrel, whose axis is at half their thickness
  butt,    ///< plates that are hinged on the faces on which their creases close
  offset,  ///< plates above films in one plane, which has all creases: valleys have gaps
};
/// Returns whether every panel is a separate part.
inline bool are_apart(CreaseCut crease) {
  return crease != CreaseCut::score && crease != CreaseCut::dash;
}
/// Returns whether the contours of plates lie back from their creases by a thickness.
inline bool are_set_back(CreaseCut crease) {
  return crease == CreaseCut::film || crease == CreaseCut::bevel || crease == CreaseCut::pin ||
         crease == CreaseCut::offset;
}
struct CreaseCutName {
  const char* name;
  CreaseCut cut;
};
inline constexpr CreaseCutName kCreaseCuts[] = {
    {"cut", CreaseCut::cut},   {"score", CreaseCut::score},  {"dash", CreaseCut::dash},
    {"film", CreaseCut::film}, {"bevel", CreaseCut::bevel},  {"pin", CreaseCut::pin},
    {"butt", CreaseCut::butt}, {"offset", CreaseCut::offset}};

/// Reads a key that holds such a name; null and wrong names, which are faults, leave `crease`.
void read_crease(ObjectReader& reader, const char* key, std::optional<CreaseCut>& crease);

/// Returns the name.
const char* crease_name(CreaseCut crease);
/// Returns the name; null for none.
Json crease_json(const std::optional<CreaseCut>& crease);

}  // namespace misalign::schema
