#include "schema/pattern/material_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

constexpr std::optional<double> kNoStrength = std::nullopt;

constexpr MaterialRow kMaterials[] = {
    {"aluminium", 70, 0.33, 2.7, kNoStrength, CreaseCut::cut,
     "the paper, section 5: what panels are made of by default; of no named alloy, so without a "
     "strength"},
    {"aluminium 5052-H32", 70.3, 0.33, 2.68, 128, CreaseCut::cut,
     "ASM data sheet: yield strength 193 MPa; 2/3 of it"},
    {"aluminium 6061-T6", 68.9, 0.33, 2.7, 184, CreaseCut::cut,
     "ASM data sheet: yield strength 276 MPa; 2/3 of it"},
    {"carbon laminate", 69.7, 0.3, 1.6, 149, CreaseCut::cut,
     "T300/5208, quasi-isotropic, by lamination theory from Tsai and Hahn, Introduction to "
     "Composite "
     "Materials, 1980; cross plies crack at 0.39 %, 271 MPa; 0.55 of it"},
    {"birch plywood", 8.75, 0.04, 0.68, 17.4, CreaseCut::cut,
     "Handbook of Finnish Plywood, 2007, 6.5 mm: mean of both directions, 29 MPa across the grain; "
     "0.6 of it. Twist along the grain is softer (shear modulus 0.62 GPa). Poisson's ratio of "
     "crossed plies, from the Wood Handbook, chapter 5"},
    {"MDF", 2.7, 0.25, 0.7, 4.6, CreaseCut::cut,
     "EN 622-5, boards of 6 to 9 mm: 23 MPa in bending; 0.2 of it. Poisson's ratio: "
     "makeitfrom.com"},
    {"cardboard", 3.2, 0.23, 0.7, kNoStrength, CreaseCut::score,
     "solid paperboard, not corrugated: Xia, Boyce and Parks, Int. J. Solids Struct. 39, 2002; "
     "geometric mean of 5.4 along and 1.9 GPa across. Density of cartonboards: 0.5 to 0.75. Damp "
     "rooms soften it"},
    {"acrylic", 2.86, 0.37, 1.19, 10.3, CreaseCut::cut,
     "designerdata.nl, PMMA (cast); Plexiglas G design guide: 1500 psi for continuous loads"},
    {"polypropylene", 1.4, 0.45, 0.91, 6.2, CreaseCut::score,
     "makeitfrom.com, unfilled PP homopolymer; ISO 15494, 10 MPa over 50 years, through 1.6. "
     "Poisson's ratio: Vinidex, material properties"},
    {"PETG", 2.2, 0.4, 1.3, 8, CreaseCut::cut,
     "makeitfrom.com, tensile strength 53 MPa; 0.15 of it. Poisson's ratio usual of glassy "
     "polymers"},
    {"PLA", 3.5, 0.36, 1.3, 7.5, CreaseCut::cut,
     "makeitfrom.com, tensile strength 50 MPa; 0.15 of it; printed solid along the load. Poisson's "
     "ratio usual of glassy polymers"}};

}  // namespace

std::span<const MaterialRow> material_table() { return kMaterials; }

const MaterialRow* find_material(std::string_view name) {
  const auto* const row = std::ranges::find(kMaterials, name, &MaterialRow::name);
  return row == std::end(kMaterials) ? nullptr : row;
}

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const MaterialRow& row : kMaterials) names.emplace_back(row.name);
  return names;
}

Json material_table_json() {
  return json_list(kMaterials, [](const MaterialRow& row) -> Json {
    return {{"name", row.name},
            {"e_gpa", row.e_gpa},
            {"poisson", row.poisson},
            {"density_g_per_cm3", row.density_g_per_cm3},
            {"strength_mpa", or_null(row.strength_mpa)},
            {"crease", crease_json(row.crease)},
            {"source", row.source}};
  });
}

std::string material_table_markdown() {
  std::string text =
      "| material | E (GPa) | Poisson's ratio | density (g/cm³) | sustained stress (MPa) | crease "
      "| "
      "source |\n|---|---|---|---|---|---|---|\n";
  for (const MaterialRow& row : kMaterials) {
    text += fmt::format("| `{}` | {:g} | {:g} | {:g} | {} | `{}` | {} |\n", row.name, row.e_gpa,
                        row.poisson, row.density_g_per_cm3,
                        row.strength_mpa ? shown_number(*row.strength_mpa) : "",
                        crease_json(row.crease).get<std::string>(), row.source);
  }
  return text;
}

}  // namespace misalign::schema
