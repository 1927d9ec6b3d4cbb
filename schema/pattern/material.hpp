// Reads the material of panels.
#pragma once

#include <optional>
#include <string>

#include "schema/files/input.hpp"
#include "schema/pattern/crease_cut.hpp"

namespace misalign::schema {

/// A material; the default is the paper's, section 5.
struct Material {
  std::string name = "aluminium";
  double e_gpa = 70;
  double poisson = 0.33;
  double density_g_per_cm3 = 2.7;
  std::optional<double> strength_mpa{};  ///< permissible sustained stress
  std::optional<CreaseCut> crease{};     ///< creases of a kit, unless the design says

  bool operator==(const Material&) const = default;
};

/// Reads a material file (material.schema.json); absent values have the defaults above, or are
/// those of the row of the material table that "like" names. Without a name it is named after the
/// file. UserError (bad_input) with every fault.
Material read_material_file(const std::string& path);
/// Reads a material at `where`, called `name` by default: an object as in a file, or the name of a
/// row of the material table. Wrong values are faults.
Material read_material(const Json& value, const std::string& where, const std::string& name,
                       InputFaults& faults);
/// Returns the material of that name, otherwise of that file. UserError (bad_request) if a text
/// without a dot or slash is neither.
Material named_material(const std::string& text);

Json material_json(const Material& material);

}  // namespace misalign::schema
