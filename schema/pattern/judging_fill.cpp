#include "schema/pattern/judging_fill.hpp"

#include <cassert>
#include <vector>

#include "schema/pattern/fill_json.hpp"

namespace misalign::schema {
namespace {

// The keys by which fillings are relaxed elsewhere, or differ from hole to hole.
constexpr const char* kOtherKeys[] = {"rest_deg", "on", "preloads_n", "single", "cut_outs"};

// Those by which a filling is or does.
std::vector<const char*> other_keys(const solver::Fill& fill) {
  const auto* const springs = std::get_if<solver::Springs>(&fill);
  const auto* const plates = std::get_if<solver::RubberPlates>(&fill);
  const bool is_said[] = {solver::rest_deg(fill) != 0,
                          springs && springs->on != solver::SpringsOn::all,
                          springs && !springs->preload.others.empty(),
                          springs && !springs->single.empty(), plates && !plates->cut_outs.empty()};
  std::vector<const char*> keys;
  for (std::size_t k = 0; k < std::size(kOtherKeys); ++k) {
    if (is_said[k]) keys.push_back(kOtherKeys[k]);
  }
  return keys;
}

std::optional<solver::Fill> read_uniform_fill(const Json& value, const std::string& where,
                                              const solver::PerforatedSheet& base,
                                              InputFaults& faults) {
  auto fill = read_fill_of(base, value, where, faults);
  if (!fill) return std::nullopt;
  if (std::holds_alternative<solver::NoFill>(*fill)) {
    faults.add(where + ".kind = \"none\"", "nothing drives the sheet",
               R"(write "springs" or "plate")");
    return std::nullopt;
  }
  const std::vector<const char*> others = other_keys(*fill);
  for (const char* key : others) {
    faults.add(where + "." + key,
               "sheets are judged by fillings that are relaxed flat and equal in all holes",
               "take it out, or write it in design.fill");
  }
  return others.empty() ? fill : std::nullopt;
}

// Its sheet does not matter, which has no holes with cut-outs of their own.
Json uniform_fill_json(const solver::Fill& fill) {
  assert(other_keys(fill).empty());
  Json json = fill_json(fill, {});
  for (const char* key : kOtherKeys) json.erase(key);
  return json;
}

}  // namespace

std::optional<solver::Fill> read_judging_fill(ObjectReader& reader,
                                              const solver::PerforatedSheet& base) {
  InputFaults& faults = reader.faults();
  const Json* const criterion = reader.find("by");
  const Json* const value = reader.said("fill");
  if (!criterion || *criterion == "diagonals") {
    if (value) {
      faults.add(reader.name("fill"), "is for sheets that are judged by energy",
                 "write " + reader.name("by") + " = \"energy\", or take it out");
    }
    return std::nullopt;
  }
  if (*criterion != "energy") {
    faults.add(reader.shown("by"), "is no criterion", R"(write "diagonals" or "energy")");
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
  return !std::holds_alternative<solver::NoFill>(fill) && solver::is_relaxed_flat(fill);
}

bool can_judge(const solver::Fill& fill) {
  return !std::holds_alternative<solver::NoFill>(fill) && other_keys(fill).empty();
}

Json judging_fill_json(const std::optional<solver::Fill>& fill) {
  return {{"by", fill ? "energy" : "diagonals"},
          {"fill", fill ? uniform_fill_json(*fill) : Json()}};
}

}  // namespace misalign::schema
