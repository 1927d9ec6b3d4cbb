// Lists materials of panels by name, each with its source.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "schema/files/input.hpp"
#include "schema/pattern/crease_cut.hpp"

namespace misalign::schema {

/// A material by name, as an isotropic plate at room temperature.
///
/// `strength_mpa` is a permissible *sustained* stress, since springs load a folded sheet for as
/// long as it is stored: the short-term strength times a factor, because most of these materials
/// creep.
/// - Metals: 2/3 of the yield strength (ASME BPVC, Section II, Part D, basis of stress values).
/// - Wood: the characteristic bending strength times k_mod of permanent loads in dry rooms, 0.6 for
///   plywood and 0.2 for MDF (EN 1995-1-1, table 3.1), without partial factors.
/// - Acrylic: 1500 psi for continuous loads, above which it crazes (Plexiglas G design guide).
/// - Polypropylene: 10 MPa, its strength over 50 years at 20 °C (ISO 15494), divided by 1.6 (ISO
///   12162).
/// - PLA and PETG: 0.15 of the tensile strength. No standard has a value; this is the share that
///   those of acrylic (0.14) and polypropylene (0.17) are of their tensile strengths.
/// - Carbon laminate: stress at which the first ply fails, times 0.55 (creep rupture of carbon
///   fibres, ACI 440.2R).
/// - None where no source gives one.
struct MaterialRow {
  std::string_view name;
  double e_gpa;
  double poisson;
  double density_g_per_cm3;
  std::optional<double> strength_mpa;
  CreaseCut crease;  ///< usual way to make a crease in it
  std::string_view source;
};

std::span<const MaterialRow> material_table();
/// Returns the row of that name; null if there is none.
const MaterialRow* find_material(std::string_view name);
std::vector<std::string> material_names();

/// Returns a list of objects; each without its "source" is a material in JSON.
Json material_table_json();
std::string material_table_markdown();

}  // namespace misalign::schema
