#include "schema/pattern/material.hpp"

#include <filesystem>

namespace misalign::schema {

Material read_material(const Json& value, const std::string& where, const std::string& name,
                       InputFaults& faults) {
  Material material;
  material.name = name;
  ObjectReader reader(value, where, faults);
  reader.text("name", material.name, "name the material, such as \"aluminium\"");
  reader.number("e_gpa", material.e_gpa, 1e-3, 1e6, "give Young's modulus in GPa, such as 70");
  reader.number("poisson", material.poisson, 0, 0.49, "give Poisson's ratio, such as 0.33");
  reader.number("density_g_per_cm3", material.density_g_per_cm3, 1e-3, 100,
                "give the density in g/cm^3, such as 2.7");
  if (reader.said("strength_mpa")) {
    material.strength_mpa = 1;
    reader.number("strength_mpa", *material.strength_mpa, 1e-3, 1e6,
                  "give the stress that it bears in MPa, such as 200");
  }
  reader.refuse_unknown_keys();
  return material;
}

Material read_material_file(const std::string& path) {
  InputFaults faults;
  const Material material =
      read_material(read_json_file(path), "",
                    printable(utf8(std::filesystem::path(path).stem().string())), faults);
  faults.refuse(path);
  return material;
}

Json material_json(const Material& material) {
  Json json = {{"name", material.name},
               {"e_gpa", material.e_gpa},
               {"poisson", material.poisson},
               {"density_g_per_cm3", material.density_g_per_cm3}};
  if (material.strength_mpa) json["strength_mpa"] = *material.strength_mpa;
  return json;
}

}  // namespace misalign::schema
