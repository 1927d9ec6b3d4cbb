#include "schema/pattern/crease_cut.hpp"

#include "schema/files/json_values.hpp"

namespace misalign::schema {

void read_crease(ObjectReader& reader, const char* key, std::optional<CreaseCut>& crease) {
  if (!reader.said(key)) return;
  const auto* const named =
      read_name(reader, key, kCreaseCuts, "is no way to make a crease",
                "write \"cut\", \"score\" or \"dash\", or null for a kit's default");
  if (named) crease = named->cut;
}

Json crease_json(const std::optional<CreaseCut>& crease) {
  for (const CreaseCutName& row : kCreaseCuts) {
    if (crease == row.cut) return row.name;
  }
  return nullptr;
}

}  // namespace misalign::schema
