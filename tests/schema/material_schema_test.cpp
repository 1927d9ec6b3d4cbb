// material.schema.json and read_material_file accept and refuse the same files.
#include "schema/files/output_file.hpp"
#include "schema/pattern/material.hpp"
#include "tests/folder.hpp"
#include "tests/schema/schema_agreement.hpp"

namespace misalign::schema {
namespace {

Material material_of(const Json& value) {
  const Folder folder("material");
  const std::string file = folder.file("brass.json");
  write_text_file(file, value.dump());
  return read_material_file(file);
}

// What the reader says: empty if it accepts.
std::string material_refusal(const Json& value) {
  try {
    material_of(value);
    return "";
  } catch (const UserError& error) {
    EXPECT_EQ(error.cause(), Cause::bad_input) << value;
    return error.what();
  }
}

Json steel() {
  return {{"name", "steel"}, {"e_gpa", 210}, {"poisson", 0.3}, {"density_g_per_cm3", 7.85}};
}

TEST(MaterialSchema, HasTheKeysAndDefaultsOfTheCode) {
  const Json defaults = material_json({});
  std::set<std::string> schema_keys;
  for (const auto& [at, property] : properties_of(material_schema())) {
    // These are written where they are said.
    if (at == "/strength_mpa" || at == "/crease" || at == "/like") {
      EXPECT_TRUE(property.at("default").is_null());
      continue;
    }
    schema_keys.insert(at);
    // Without a name it has its file's.
    EXPECT_EQ(property.value("default", Json()), at == "/name" ? Json() : defaults[Pointer(at)])
        << at;
  }
  EXPECT_EQ(schema_keys, keys_of(defaults));
}

TEST(MaterialSchema, WhatIsAbsentIsAsTheDefaultsSay) {
  EXPECT_EQ(complaint(material_schema(), Json::object()), "");
  EXPECT_EQ(material_json(material_of(Json::object())), with(material_json({}), "/name", "brass"));
  EXPECT_EQ(material_json(material_of(steel())), steel());
  const Json good = steel();
  for (const auto& [key, value] : good.items()) {
    const Json shorter = without(good, Pointer("/" + key));
    EXPECT_EQ(complaint(material_schema(), shorter), "") << key;
    const Json usual = key == "name" ? Json("brass") : material_json({})[key];
    EXPECT_EQ(material_json(material_of(shorter)), with(good, "/" + key, usual)) << key;
  }
}

TEST(MaterialSchema, RefusesWhatTheCodeRefuses) {
  constexpr Mutation kBadMaterials[] = {
      {"/extra", "1"},
      {"/E_gpa", "70"},
      {"/name", "7"},
      {"/name", "null"},
      {"/name", "[\"steel\"]"},
      {"/e_gpa", "0"},
      {"/e_gpa", "0.0009"},
      {"/e_gpa", "-70"},
      {"/e_gpa", "1000001"},
      {"/e_gpa", "\"70\""},
      {"/e_gpa", "null"},
      {"/e_gpa", "[70]"},
      {"/e_gpa", "true"},
      {"/poisson", "-0.01"},
      {"/poisson", "0.491"},
      {"/poisson", "null"},
      {"/density_g_per_cm3", "0"},
      {"/density_g_per_cm3", "0.0009"},
      {"/density_g_per_cm3", "100.1"},
      {"/density_g_per_cm3", "{}"},
      {"/like", "\"steel\""},
      {"/like", "7"},
      {"/crease", "\"fold\""},
  };
  for (const Mutation& mutation : kBadMaterials) {
    const Json value = with(steel(), mutation.at, Json::parse(mutation.value));
    EXPECT_NE(complaint(material_schema(), value), "") << "the schema accepts " << value;
    const std::string sentence = material_refusal(value);
    EXPECT_NE(sentence.find(dotted(Pointer(mutation.at))), std::string::npos)
        << value << " is not refused by name: " << sentence;
  }
  for (const Json& value : {Json::array(), Json(7), Json("steel"), Json()}) {
    EXPECT_NE(complaint(material_schema(), value), "") << value;
    EXPECT_NE(material_refusal(value), "") << value;
  }
}

TEST(MaterialSchema, AcceptsWhatTheCodeAccepts) {
  constexpr Mutation kGoodMaterials[] = {
      {"/name", "\"\""},
      {"/name", "\"two words\""},
      {"/e_gpa", "0.001"},
      {"/e_gpa", "1000000"},
      {"/poisson", "0"},
      {"/poisson", "0.49"},
      {"/density_g_per_cm3", "0.001"},
      {"/density_g_per_cm3", "100"},
      {"/like", "\"birch plywood\""},
      {"/like", "null"},
      {"/crease", "\"cut\""},
      {"/crease", "null"},
  };
  for (const Mutation& mutation : kGoodMaterials) {
    const Json value = with(steel(), mutation.at, Json::parse(mutation.value));
    EXPECT_EQ(complaint(material_schema(), value), "") << value;
    EXPECT_EQ(material_refusal(value), "") << value;
  }
}

}  // namespace
}  // namespace misalign::schema
