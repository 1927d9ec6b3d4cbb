#include "schema/report/stress_result.hpp"

#include <algorithm>

#include "schema/exchange/calculix_result.hpp"
#include "schema/files/base64.hpp"
#include "schema/files/json_values.hpp"
#include "solver/pattern/outline.hpp"

namespace misalign::schema {
namespace {

constexpr const char* kSuggestion = "name the NAME-stress.json that `misalign stress` writes";
constexpr double kMost = kLargestResult;

// The value of a required key; null if it is missing.
const Json& part(ObjectReader& reader, const std::string& key) {
  static const Json kNothing;
  reader.require(key, kSuggestion);
  const Json* value = reader.find(key);
  return value ? *value : kNothing;
}

double number(ObjectReader& reader, const std::string& key, double least, double most = kMost) {
  double value = 0;
  reader.require(key, kSuggestion);
  reader.number(key, value, least, most, kSuggestion);
  return value;
}

std::string text(ObjectReader& reader, const std::string& key) {
  std::string value;
  reader.require(key, kSuggestion);
  reader.text(key, value, kSuggestion);
  return value;
}

std::vector<double> numbers(ObjectReader& reader, const std::string& key) {
  const Json& list = part(reader, key);
  if (are_numbers(list, list.size())) return list.get<std::vector<double>>();
  reader.faults().add(reader.name(key), "must be a list of numbers", kSuggestion);
  return {};
}

// Times and values in base64; at least `least` of them.
Json curve(ObjectReader& top, const std::string& key, const std::string& values_key,
           std::size_t least) {
  ObjectReader reader(part(top, key), key, top.faults());
  const std::vector<double> time_s = numbers(reader, "time_s");
  const std::vector<double> values = numbers(reader, values_key);
  if (time_s.size() != values.size() || time_s.size() < least ||
      !std::is_sorted(time_s.begin(), time_s.end())) {
    top.faults().add(key, "time_s must ascend, with a value of " + values_key + " for each",
                     kSuggestion);
  }
  const auto floats = [](const std::vector<double>& list) {
    return base64(std::vector<float>(list.begin(), list.end()));
  };
  return {{"time_s", floats(time_s)}, {values_key, floats(values)}};
}

std::array<int, 2> place(ObjectReader& reader, const std::string& key) {
  const Json& value = part(reader, key);
  if (value.is_array() && value.size() == 2 && value[0].is_number_unsigned() &&
      value[1].is_number_unsigned()) {
    return {value[0].get<int>(), value[1].get<int>()};
  }
  reader.faults().add(reader.name(key), "must be a [row, column]", kSuggestion);
  return {};
}

Json largest(ObjectReader& top) {
  const std::string key = "largest_outside_discs";
  const Json& value = part(top, key);
  if (value.is_null()) return nullptr;  // no node lies there
  ObjectReader reader(value, key, top.faults());
  return {{"stress_mpa", number(reader, "stress_mpa", 0)},
          {"time_s", number(reader, "time_s", 0)},
          {"panel", place(reader, "panel")},
          {"x_mm", number(reader, "x_mm", -kMost)},
          {"y_mm", number(reader, "y_mm", -kMost)}};
}

Json whose(ObjectReader& top) {
  if (top.find("pattern")) {
    return {{"pattern", text(top, "pattern")}, {"sheet", text(top, "sheet")}};
  }
  std::uint64_t draw = 0;
  top.require("draw", kSuggestion);
  top.whole("draw", draw, ~std::uint64_t{0}, kSuggestion);
  return {{"draw", draw}, {"campaign", text(top, "campaign")}};
}

std::vector<std::pair<std::array<int, 2>, double>> panels(ObjectReader& top) {
  const Json& list = part(top, "panels");
  if (!list.is_array() || list.empty()) {
    top.faults().add("panels", "must be a list with an entry for each panel", kSuggestion);
    return {};
  }
  std::vector<std::pair<std::array<int, 2>, double>> panels_mpa;
  for (const Json& entry : list) {
    ObjectReader reader(entry, "panels[" + std::to_string(panels_mpa.size()) + "]", top.faults());
    const std::array<int, 2> at = place(reader, "panel");
    panels_mpa.emplace_back(at, number(reader, "outside_discs_mpa", 0));
  }
  return panels_mpa;
}

Json run(ObjectReader& top) {
  const std::string outcome = text(top, "outcome");
  if (outcome != "deployed" && outcome != "failed" && outcome != "time_limit" &&
      outcome != "stopped") {
    top.faults().add("outcome", "must be deployed, failed, time_limit or stopped", kSuggestion);
  }
  ObjectReader material(part(top, "material"), "material", top.faults());
  return {{"from_deg", number(top, "from_deg", 0, 180)},
          {"stiffness_n_per_mm", number(top, "stiffness_n_per_mm", 0)},
          {"thickness_mm", number(top, "thickness_mm", 0)},
          {"elements_a_side", number(top, "elements_a_side", 1)},
          {"disc_mm", number(top, "disc_mm", 0)},
          {"material", {{"name", text(material, "name")}, {"e_gpa", number(material, "e_gpa", 0)}}},
          {"outcome", outcome},
          {"deployed_s",
           part(top, "deployed_s").is_null() ? Json() : Json(number(top, "deployed_s", 0))},
          {"largest", largest(top)},
          {"motion", curve(top, "motion", "pilot_deg", 1)},
          {"rigid_motion", curve(top, "rigid_motion", "pilot_deg", 0)},
          {"history", curve(top, "stress", "outside_discs_mpa", 0)}};
}

}  // namespace

StressResult read_stress_result(const std::string& path) {
  const Json json = read_json_file(path);
  InputFaults faults;
  ObjectReader top(json, "", faults);
  StressResult result{path, whose(top), panels(top), run(top)};
  if (faults.none()) return result;
  // A file of another kind lacks nearly every key: one sentence is enough.
  throw UserError(Cause::bad_input,
                  path + ": is no result of `misalign stress`: " + faults.sentences().front());
}

Json stress_shown_json(const StressResult& result, const Pattern& base) {
  const solver::CreasePattern& sheet = base.base.sheet;
  const std::vector<int> kept = solver::kept_facets(sheet, base.base.holes);
  Json panels_mpa = Json::array();
  for (const int f : kept) {
    const auto at = std::find_if(result.panels_mpa.begin(), result.panels_mpa.end(),
                                 [&](const auto& entry) { return entry.first == sheet.places[f]; });
    if (at != result.panels_mpa.end()) panels_mpa.push_back(at->second);
  }
  if (panels_mpa.size() != kept.size() || result.panels_mpa.size() != kept.size()) {
    throw UserError(Cause::bad_input, result.path +
                                          ": its panels are not those of its sheet (it was "
                                          "altered); run `misalign stress` again");
  }
  Json json = result.shown;
  json["panels_mpa"] = panels_mpa;
  return json;
}

}  // namespace misalign::schema
