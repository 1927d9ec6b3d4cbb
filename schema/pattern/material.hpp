// Reads the material of panels.
#pragma once

#include <optional>
#include <string>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// A material; the default is the paper's, section 5.
struct Material {
  std::string name = "aluminium";
  double e_gpa = 70;
  double poisson = 0.33;
  double density_g_per_cm3 = 2.7;
  std::optional<double> strength_mpa{};  ///< permissible sustained stress
};

/// Reads a material file (material.schema.json); absent values have the defaults above, except the
/// name, which is then the file's. UserError (bad_input) with every fault.
Material read_material_file(const std::string& path);
/// Reads a material from an object at `where`, called `name` by default; wrong values are faults.
Material read_material(const Json& value, const std::string& where, const std::string& name,
                       InputFaults& faults);

Json material_json(const Material& material);

}  // namespace misalign::schema
