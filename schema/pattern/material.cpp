#include "schema/pattern/material.hpp"

#include <filesystem>

#include "schema/files/suggestion.hpp"
#include "schema/pattern/material_table.hpp"

namespace misalign::schema {
namespace {

constexpr const char* kWriteOne = "write a name that `misalign config --materials` lists";

std::string why_unknown(const std::string& typed) {
  return "is no material of the table" + meant_names(typed, material_names());
}

Material material_of(const MaterialRow& row) {
  return {std::string(row.name), row.e_gpa,        row.poisson,
          row.density_g_per_cm3, row.strength_mpa, row.crease};
}

// Returns the row that a text names; null, with a fault, if there is none.
const MaterialRow* row_named(const Json& text, const std::string& shown, InputFaults& faults) {
  const MaterialRow* row = text.is_string() ? find_material(text.get<std::string>()) : nullptr;
  if (!row) {
    faults.add(shown, text.is_string() ? why_unknown(text.get<std::string>()) : "must be a name",
               kWriteOne);
  }
  return row;
}

void read_strength(ObjectReader& reader, std::optional<double>& strength_mpa) {
  const Json* value = reader.find("strength_mpa");
  if (!value) return;
  strength_mpa.reset();
  if (value->is_null()) return;
  strength_mpa = 1;
  reader.number("strength_mpa", *strength_mpa, 1e-3, 1e6,
                "give the stress that it bears in MPa, such as 200");
}

Material read_object(const Json& value, const std::string& where, const std::string& name,
                     InputFaults& faults) {
  Material material;
  material.name = name;
  ObjectReader reader(value, where, faults);
  const Json* like = reader.said("like");
  const MaterialRow* row = like ? row_named(*like, reader.shown("like"), faults) : nullptr;
  if (row) material = material_of(*row);
  reader.number("e_gpa", material.e_gpa, 1e-3, 1e6, "give Young's modulus in GPa, such as 70");
  reader.number("poisson", material.poisson, 0, 0.49, "give Poisson's ratio, such as 0.33");
  reader.number("density_g_per_cm3", material.density_g_per_cm3, 1e-3, 100,
                "give the density in g/cm^3, such as 2.7");
  read_strength(reader, material.strength_mpa);
  read_crease(reader, "crease", material.crease);
  if (row && material != material_of(*row)) material.name = "like " + material.name;
  reader.text("name", material.name, "name the material, such as \"aluminium\"");
  reader.refuse_unknown_keys();
  return material;
}

}  // namespace

Material read_material(const Json& value, const std::string& where, const std::string& name,
                       InputFaults& faults) {
  if (!value.is_string()) return read_object(value, where, name, faults);
  const MaterialRow* row = row_named(
      value,
      where + " = " + shortened(value.dump(-1, ' ', false, Json::error_handler_t::replace), 60),
      faults);
  return row ? material_of(*row) : Material();
}

Material read_material_file(const std::string& path) {
  InputFaults faults;
  const Material material =
      read_object(read_json_file(path), "",
                  printable(utf8(std::filesystem::path(path).stem().string())), faults);
  faults.refuse(path);
  return material;
}

Material named_material(const std::string& text) {
  if (const MaterialRow* row = find_material(text)) return material_of(*row);
  std::error_code ignored;
  if (text.find_first_of("./") == std::string::npos && !std::filesystem::exists(text, ignored)) {
    throw UserError(
        solver::OptionFault{"material", text, why_unknown(text) + ", and no file",
                            std::string(kWriteOne) + ", or a JSON file such as steel.json"});
  }
  return read_material_file(text);
}

Json material_json(const Material& material) {
  Json json = {{"name", material.name},
               {"e_gpa", material.e_gpa},
               {"poisson", material.poisson},
               {"density_g_per_cm3", material.density_g_per_cm3}};
  if (material.strength_mpa) json["strength_mpa"] = *material.strength_mpa;
  if (material.crease) json["crease"] = crease_json(material.crease);
  return json;
}

}  // namespace misalign::schema
