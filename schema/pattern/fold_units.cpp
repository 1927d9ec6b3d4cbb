#include "schema/pattern/fold_units.hpp"

#include <map>

namespace misalign::schema {

std::optional<double> mm_of_unit(const Json& frame_unit) {
  static const std::map<std::string, double> kUnits = {{"unit", 1},  {"mm", 1},        {"cm", 10},
                                                       {"m", 1000},  {"um", 1e-3},     {"nm", 1e-6},
                                                       {"in", 25.4}, {"pt", 25.4 / 72}};
  const auto unit =
      frame_unit.is_string() ? kUnits.find(frame_unit.get<std::string>()) : kUnits.end();
  return unit == kUnits.end() ? std::nullopt : std::optional(unit->second);
}

}  // namespace misalign::schema
