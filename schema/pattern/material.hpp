// The material of panels.
#pragma once

#include <optional>
#include <string>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// The paper's, section 5.
struct Material {
  std::string name = "aluminium";
  double e_gpa = 70;
  double poisson = 0.33;
  double density_g_per_cm3 = 2.7;
  std::optional<double> strength_mpa{};  ///< the stress it bears for long
};

/// A material file (material.schema.json); what is absent is as above, but for the name, which is
/// then the file's. UserError (bad_input) with every fault.
Material read_material_file(const std::string& path);
/// The same of an object at `where`, called `name` where it has none; what is wrong is a fault.
Material read_material(const Json& value, const std::string& where, const std::string& name,
                       InputFaults& faults);

Json material_json(const Material& material);

}  // namespace misalign::schema
