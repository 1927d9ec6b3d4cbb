#include "schema/campaign/key_list.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/files/carried_files.hpp"
#include "schema/files/input.hpp"

namespace misalign::schema {
namespace {

using KeyJson = nlohmann::ordered_json;  // keeps the order of the schema

// Returns the text as a cell of a Markdown table.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.insert(at, "\\");
  }
  return text;
}

std::string type_of(const KeyJson& key) {
  if (key.contains("enum")) {
    std::vector<std::string> names;
    for (const KeyJson& name : key["enum"]) names.push_back("`" + name.dump() + "`");
    return fmt::to_string(fmt::join(names, ", "));
  }
  if (key.contains("anyOf")) {
    std::vector<std::string> types;
    for (const KeyJson& type : key["anyOf"]) {
      if (types.empty() || types.back() != type_of(type)) types.push_back(type_of(type));
    }
    return fmt::to_string(fmt::join(types, ", or "));
  }
  if (key["type"].is_array()) {
    return fmt::to_string(fmt::join(key["type"].get<std::vector<std::string>>(), " or "));
  }
  if (key["type"] == "array") return "list of " + type_of(key["items"]);
  return key["type"];
}

std::string bounds_of(const KeyJson& key) {
  const KeyJson& bounded = key.contains("anyOf") ? key["anyOf"][0] : key;
  const auto number = [](const KeyJson& value) {
    return value.is_number_integer() ? value.dump() : shown_number(value.get<double>());
  };
  std::string text;
  if (bounded.contains("minimum")) text = number(bounded["minimum"]) + " to ";
  if (bounded.contains("maximum")) text += number(bounded["maximum"]);
  return text;
}

void append_keys(const KeyJson& object, const std::string& prefix, std::string& text) {
  const KeyJson required = object.value("required", KeyJson::array());
  for (const auto& [name, key] : object.at("properties").items()) {
    const bool has_keys = key.contains("properties");
    const bool needed = std::find(required.begin(), required.end(), name) != required.end();
    const std::string standard = key.contains("default") ? "`" + key["default"].dump() + "`"
                                 : needed                ? "*needed*"
                                                         : "";
    text += "| `" + prefix + name + "` | " + (has_keys ? "" : cell(type_of(key))) + " | " +
            standard + " | " + bounds_of(key) + " | " + cell(key["description"]) + " |\n";
    if (has_keys) append_keys(key, prefix + name + ".", text);
  }
}

}  // namespace

std::string campaign_keys_markdown() {
  const auto& files = carried_files();
  const auto schema = std::find_if(files.begin(), files.end(), [](const CarriedFile& file) {
    return file.path == "schema/campaign.schema.json";
  });
  std::string text = "| key | type | default | bounds | meaning |\n|---|---|---|---|---|\n";
  append_keys(KeyJson::parse(schema->text), "", text);
  return text;
}

}  // namespace misalign::schema
