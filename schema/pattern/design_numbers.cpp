#include "schema/pattern/design_numbers.hpp"

#include <string>

#include "schema/files/json_values.hpp"

namespace misalign::schema {

void read_number(ObjectReader& reader, const DesignNumber& row, Design& design) {
  const std::string key(row.key);
  const Json* value = reader.find(key);
  if (!value || (value->is_null() && !row.standard)) return;
  double number = row.standard.value_or(row.least);
  reader.number(key, number, row.least, row.most, row.suggestion);
  design.*row.number = number;
}

void read_numbers(ObjectReader& reader, std::string_view block, Design& design) {
  for (const DesignNumber& row : design_numbers()) {
    if (row.block == block) read_number(reader, row, design);
  }
}

Json numbers_json(const Design& design, std::string_view block) {
  Json json = Json::object();
  for (const DesignNumber& row : design_numbers()) {
    const std::optional<double>& value = design.*row.number;
    if (row.block == block) json[std::string(row.key)] = or_null(value ? value : row.standard);
  }
  return json;
}

}  // namespace misalign::schema
