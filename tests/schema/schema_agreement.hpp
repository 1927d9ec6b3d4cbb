// The JSON schemas of schema/ as a validator sees them, next to what the code says of the same
// JSON.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/database.hpp"
#include "schema/exchange/folding_json.hpp"
#include "schema/files/carried_files.hpp"

namespace misalign::schema {

using Pointer = Json::json_pointer;

inline Json source_json(const std::string& path) {
  return read_json_file(std::string(MISALIGN_SOURCE_DIR) + "/" + path);
}

inline Json campaign_schema() { return source_json("schema/campaign.schema.json"); }
inline Json candidate_schema() { return source_json("schema/candidate.schema.json"); }
inline Json material_schema() { return source_json("schema/material.schema.json"); }

/// What valijson says of `value`: empty if it is valid.
inline std::string complaint(const Json& schema_json, const Json& value) {
  valijson::Schema schema;
  valijson::SchemaParser parser;
  parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  valijson::Validator validator;
  valijson::ValidationResults results;
  if (validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(value), &results)) {
    return "";
  }
  std::string text = "invalid";
  for (const auto& error : results) text += "; " + error.description;
  return text;
}

/// What read_campaign says: empty if it accepts.
inline std::string refusal(const Json& value) {
  try {
    read_campaign(value, "mutation");
    return "";
  } catch (const UserError& error) {
    EXPECT_EQ(error.cause(), Cause::bad_input) << value;
    return error.what();
  }
}

/// Calls `see(pointer, value)` for every value in a document, parents first.
inline void walk(const Json& value, const std::function<void(const Pointer&, const Json&)>& see,
                 const Pointer& at = Pointer()) {
  see(at, value);
  if (value.is_object()) {
    for (const auto& [key, child] : value.items()) walk(child, see, at / key);
  } else if (value.is_array()) {
    for (std::size_t k = 0; k < value.size(); ++k) walk(value[k], see, at / k);
  }
}

/// "/pattern/rows" -> "pattern.rows", the name that a sentence gives the key.
inline std::string dotted(const Pointer& at) {
  std::string name = at.to_string().substr(at.empty() ? 0 : 1);
  std::replace(name.begin(), name.end(), '/', '.');
  return name;
}

/// Pointers of all keys: in a document, and in a schema's nested "properties".
inline std::set<std::string> keys_of(const Json& document) {
  std::set<std::string> keys;
  walk(document, [&](const Pointer& at, const Json&) {
    if (!at.empty()) keys.insert(at.to_string());
  });
  return keys;
}

inline void collect_properties(const Json& schema, const Pointer& at,
                               std::map<std::string, Json>& properties) {
  if (!schema.contains("properties")) return;
  for (const auto& [key, child] : schema["properties"].items()) {
    properties[(at / key).to_string()] = child;
    collect_properties(child, at / key, properties);
  }
}

inline std::map<std::string, Json> properties_of(const Json& schema) {
  std::map<std::string, Json> properties;
  collect_properties(schema, Pointer(), properties);
  return properties;
}

inline Json with(Json document, const std::string& at, Json value) {
  document[Pointer(at)] = std::move(value);
  return document;
}

inline Json without(Json document, const Pointer& at) {
  document[at.parent_pointer()].erase(at.back());
  return document;
}

struct Mutation {
  const char* at;     // where the default campaign is changed
  const char* value;  // to what, as JSON
};

}  // namespace misalign::schema
