#include "schema/pattern/crease_cut.hpp"

#include <algorithm>

#include "schema/files/json_values.hpp"

namespace misalign::schema {

void read_crease(ObjectReader& reader, const char* key, std::optional<CreaseCut>& crease) {
  if (!reader.said(key)) return;
  const auto* const named = read_name(reader, key, kCreaseCuts, "is no way to make a crease",
                                      "write \"cut\", \"score\", \"dash\", \"film\", \"bevel\", "
                                      "\"pin\", \"butt\" or \"offset\", or null for a "
                                      "kit's default");
  if (named) crease = named->cut;
}

const char* crease_name(CreaseCut crease) {
  return std::ranges::find(kCreaseCuts, crease, &CreaseCutName::cut)->name;
}

Json crease_json(const std::optional<CreaseCut>& crease) {
  return crease ? Json(crease_name(*crease)) : Json();
}

}  // namespace misalign::schema
