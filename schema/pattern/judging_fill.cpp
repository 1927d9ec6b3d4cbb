#include "schema/pattern/judging_fill.hpp"

#include "schema/pattern/fill_json.hpp"

namespace misalign::schema {
namespace {

constexpr const char* kCriteria = R"(write "diagonals" or "energy")";

// Keys of fillings that are relaxed elsewhere, or differ from hole to hole.
constexpr const char* kOtherKeys[] = {"rest_deg", "on", "preloads_n", "single", "cut_outs"};

std::optional<solver::Fill> read_uniform_fill(const Json& value, const std::string& where,
                                              const solver::PerforatedSheet& base,
                                              InputFaults& faults) {
  if (value.is_object() && value.value("kind", Json()) == "none") {
    faults.add(where + ".kind = \"none\"", "nothing drives the sheet",
               R"(write "springs" or "plate")");
    return std::nullopt;
  }
  const std::size_t before = faults.count();
  for (const char* key : kOtherKeys) {
    if (!value.is_object() || value.value(key, Json()).is_null()) continue;
    faults.add(where + "." + key,
               "sheets are judged by fillings that are relaxed flat and equal in all holes",
               "take it out, or write it in design.fill");
  }
  if (faults.count() > before) return std::nullopt;
  return read_fill_of(base, value, where, faults);
}

Json uniform_fill_json(const solver::Fill& fill) {
  if (const auto* const springs = std::get_if<solver::Springs>(&fill)) {
    return {{"kind", "springs"},
            {"stiffness_n_per_mm", springs->stiffness_n_per_mm},
            {"preload_n", springs->preload.each_n},
            {"pull_only", springs->pull_only}};
  }
  const auto& plates = std::get<solver::RubberPlates>(fill);
  return {{"kind", "plate"},
          {"shear_mpa", plates.shear_mpa},
          {"thickness_mm", plates.thickness_mm},
          {"prestretch", plates.prestretch}};
}

}  // namespace

std::optional<solver::Fill> read_judging_fill(ObjectReader& reader,
                                              const solver::PerforatedSheet& base) {
  InputFaults& faults = reader.faults();
  std::string criterion = "diagonals";
  reader.text("by", criterion, kCriteria);
  if (criterion != "diagonals" && criterion != "energy") {
    faults.add(reader.shown("by"), "is no criterion", kCriteria);
  }
  const Json* const value = reader.said("fill");
  if (criterion != "energy") {
    if (value) {
      faults.add(reader.name("fill"), "is for sheets that are judged by energy",
                 "write " + reader.name("by") + " = \"energy\", or take it out");
    }
    return std::nullopt;
  }
  if (!value) return solver::Springs{};
  const auto fill = read_uniform_fill(*value, reader.name("fill"), base, faults);
  if (fill && std::holds_alternative<solver::RubberPlates>(*fill) && !base.springs.at_vertices()) {
    faults.add(reader.name("fill") + ".kind = \"plate\"",
               "plates are bonded to the holes' edges, and these diagonals end elsewhere",
               "take \"springs\" out of the pattern, or write \"springs\"");
  }
  return fill ? fill : solver::Springs{};
}

bool drives_to_flat(const solver::Fill& fill) {
  const auto* const springs = std::get_if<solver::Springs>(&fill);
  return !std::holds_alternative<solver::NoFill>(fill) && solver::rest_deg(fill) == 0 &&
         (!springs || (springs->other_rests_deg.empty() && springs->on == solver::SpringsOn::all));
}

Json judging_fill_json(const std::optional<solver::Fill>& fill) {
  return {{"by", fill ? "energy" : "diagonals"},
          {"fill", fill ? uniform_fill_json(*fill) : Json()}};
}

}  // namespace misalign::schema
