#include "schema/pattern/design.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>

#include "schema/files/json_values.hpp"
#include "schema/pattern/preload_json.hpp"
#include "solver/studies/wanted.hpp"

namespace misalign::schema {
namespace {

using Number = std::optional<double> Design::*;

struct DesignNumber {
  std::string_view block, key;  // of "springs" "stiffness_n_per_mm"; of the block itself ""
  Number number;
  Bounds bounds;
  std::optional<double> standard;  // what holds where it is not said; none: null
  const char* suggestion;
};

// Stiffness, stroke and friction as `actuators` and `deploy` had them.
constexpr DesignNumber kNumbers[] = {
    {"", "from_deg", &Design::from_deg, {0.01, 180}, {}, "try 140, or null for each sheet's D"},
    {"springs",
     "stiffness_n_per_mm",
     &Design::stiffness_n_per_mm,
     {1e-6, 1e9},
     solver::Actuators{}.stiffness_n_per_mm,
     "try 50, the paper's springs"},
    {"springs",
     "stroke_limit",
     &Design::stroke_limit,
     {1e-6, 1},
     {},
     "write a share of the flat length, 0.08 for Ti-Ni wires, or null for no limit"},
    {"springs",
     "preload_n",
     &Design::preload_n,
     {0, 1e6},
     0,
     "try 3: what each pulls or pushes with at flat"},
    {"springs",
     "largest_force_n",
     &Design::largest_force_n,
     {1e-6, 1e9},
     {},
     "write what the spring bears, or null for no limit"},
    {"hinges",
     "friction_n_mm_per_mm",
     &Design::friction_n_mm_per_mm,
     {0, 1e9},
     0,
     "try 0.02, or 0 for none"},
    {"hinges",
     "stiffness_n_mm_per_mm",
     &Design::hinge_stiffness_n_mm_per_mm,
     {0, 1e9},
     0,
     "try 0.1, or 0 for none"},
    {"hinges",
     "pin_friction_mm",
     &Design::pin_friction_mm,
     {0, 1e6},
     {},
     "write the radius of the pins times their friction coefficient, such as 0.075, or null"},
    {"",
     "thickness_mm",
     &Design::thickness_mm,
     {1e-3, 100},
     {},
     "try 1, or null for what studies take by themselves"},
    {"", "miscut_mm", &Design::miscut_mm, {0, 1e6}, {}, "try 0.05, or null where none is known"},
    {"", "play_mm", &Design::play_mm, {1e-9, 1e6}, {}, "try 0.01, or null where none is known"},
    {"wanted",
     "static_margin",
     &Design::static_margin,
     {0, 1e9},
     solver::kWantedMargin,
     "write 1, as AIAA S-114 asks at every position"},
    {"wanted",
     "margin_to_deg",
     &Design::margin_to_deg,
     {0.1, 180},
     solver::kMarginTo_deg,
     "try 1: margins are asked from from_deg down to this angle"},
    {"wanted",
     "energy_margin",
     &Design::energy_margin,
     {0, 1e9},
     solver::kWantedMargin,
     "write 1: twice the friction that is there"},
    {"wanted",
     "yield",
     &Design::yield,
     {0, 1},
     solver::kWantedShare,
     "write a share of miscut copies, such as 0.95"},
    {"wanted",
     "landing_deg_per_s",
     &Design::landing_deg_per_s,
     {0, 1e9},
     {},
     "write how fast it may be when it is flat, or null for no limit"}};

constexpr std::string_view kBlocks[] = {"springs", "hinges", "wanted"};

const Json& part_of(ObjectReader& reader, const char* key) {
  static const Json kEmpty = Json::object();
  const Json* found = reader.find(key);
  return found ? *found : kEmpty;
}

// Null says nothing where there is no standard.
void read_numbers(ObjectReader& reader, std::string_view block, Design& design) {
  for (const DesignNumber& one : kNumbers) {
    if (one.block != block) continue;
    const std::string key(one.key);
    const Json* value = reader.find(key);
    if (!value || (value->is_null() && !one.standard)) continue;
    double number = one.standard.value_or(one.bounds.least);
    reader.number(key, number, one.bounds.least, one.bounds.most, one.suggestion);
    design.*one.number = number;
  }
}

void read_hinge_kind(ObjectReader& reader, std::optional<CreaseCut>& kind) {
  const Json* value = reader.find("kind");
  if (!value || value->is_null()) return;
  const auto* const named = std::ranges::find_if(
      kCreaseCuts, [&](const CreaseCutName& one) { return *value == one.name; });
  if (named == std::end(kCreaseCuts)) {
    reader.faults().add(reader.shown("kind"), "is no way to make a crease",
                        "write \"cut\", \"score\" or \"dash\", or null for what a kit has");
  } else {
    kind = named->cut;
  }
}

void read_film(ObjectReader& reader, std::optional<solver::FilmHinge>& film) {
  constexpr double kMost = 1e6;
  const Json* value = reader.find("film");
  if (!value || value->is_null()) return;
  solver::FilmHinge read{0, 0, 0};
  ObjectReader part(*value, reader.name("film"), reader.faults());
  for (const char* key : {"thickness_mm", "e_gpa", "length_mm"}) {
    part.require(key, R"(write {"thickness_mm": 0.05, "e_gpa": 2.5, "length_mm": 1})");
  }
  part.number("thickness_mm", read.thickness_mm, 1e-6, kMost, "try 0.05");
  part.number("e_gpa", read.e_gpa, 1e-6, kMost, "give Young's modulus in GPa, 2.5 of polyimide");
  part.number("length_mm", read.length_mm, 1e-6, kMost, "write how much of it is free, such as 1");
  part.number("loss", read.loss, 0, 1, "write the loss factor, such as 0.01, or 0");
  part.refuse_unknown_keys();
  film = read;
}

Json film_json(const solver::FilmHinge& film) {
  return {{"thickness_mm", film.thickness_mm},
          {"e_gpa", film.e_gpa},
          {"length_mm", film.length_mm},
          {"loss", film.loss}};
}

void read_hold(ObjectReader& reader, Design& design) {
  constexpr int kMostPlace = 1000;  // of a row or column; whether there is such a panel, says who
                                    // holds it
  const Json* value = reader.find("hold");
  if (!value || value->is_null()) return;
  const auto is_place = [](const Json& one) {
    return one.is_number_integer() && one >= 0 && one < kMostPlace;
  };
  if (value->is_array() && value->size() == 2 && std::ranges::all_of(*value, is_place)) {
    design.hold = {value->at(0).get<int>(), value->at(1).get<int>()};
  } else {
    reader.faults().add(reader.shown("hold"), "is no panel, row and column counted from 0",
                        "write [0, 0], or null to let the sheet go free in space");
  }
}

void read_gravity(ObjectReader& reader, Design& design) {
  constexpr double kMostGravities = 1e3;
  const Json* value = reader.find("gravity");
  if (!value || value->is_null()) return;
  const auto is_component = [](const Json& one) {
    return one.is_number() && std::abs(one.get<double>()) <= kMostGravities;
  };
  if (value->is_array() && value->size() == 3 && std::ranges::all_of(*value, is_component)) {
    design.gravity = {value->at(0).get<double>(), value->at(1).get<double>(),
                      value->at(2).get<double>()};
  } else {
    reader.faults().add(reader.shown("gravity"),
                        "must be three numbers of standard gravities, from -1000 to 1000",
                        "write [0, 0, -1], or null for no weight");
  }
}

}  // namespace

Design Design::instead_of(Design other) const {
  const auto take = [&](auto member) {
    if (this->*member) other.*member = this->*member;
  };
  if (preload_n || !other_preloads.empty()) other.other_preloads = other_preloads;
  for (const DesignNumber& one : kNumbers) take(one.number);
  take(&Design::hinge_kind);
  take(&Design::film);
  take(&Design::material);
  take(&Design::hold);
  take(&Design::gravity);
  return other;
}

solver::Actuators Design::actuators() const {
  solver::Actuators actuators;
  actuators.stiffness_n_per_mm = stiffness_n_per_mm.value_or(actuators.stiffness_n_per_mm);
  actuators.stroke_limit = stroke_limit;
  actuators.preload = {preload_n.value_or(0), other_preloads};
  return actuators;
}

double Design::hinge_elastic_n_mm_per_mm() const {
  if (hinge_stiffness_n_mm_per_mm || !film) return hinge_stiffness_n_mm_per_mm.value_or(0);
  return film->stiffness_n_mm_per_mm();
}

solver::Plates Design::plates() const {
  solver::Plates plates;
  plates.thickness_mm = thickness_mm.value_or(plates.thickness_mm);
  if (material) plates.density_g_per_cm3 = material->density_g_per_cm3;
  return plates;
}

Bounds design_bounds(std::string_view key) {
  const auto* const entry = std::ranges::find_if(kNumbers, [&](const DesignNumber& one) {
    const std::string name = (one.block.empty() ? "" : std::string(one.block) + ".");
    return name + std::string(one.key) == key;
  });
  assert(entry != std::end(kNumbers));
  return entry->bounds;
}

Design read_design(const Json& value, const std::string& where, InputFaults& faults) {
  Design design;
  ObjectReader reader(value, where, faults);
  read_numbers(reader, "", design);
  for (const std::string_view block : kBlocks) {
    const std::string name(block);
    ObjectReader part(part_of(reader, name.c_str()), reader.name(name), faults);
    read_numbers(part, block, design);
    if (block == "springs") read_preloads(part, design.other_preloads);
    if (block == "hinges") {
      read_hinge_kind(part, design.hinge_kind);
      read_film(part, design.film);
    }
    part.refuse_unknown_keys();
  }
  if (const Json* material = reader.find("material"); material && !material->is_null()) {
    design.material = read_material(*material, reader.name("material"), "the design's", faults);
  }
  read_hold(reader, design);
  read_gravity(reader, design);
  reader.refuse_unknown_keys();
  return design;
}

Design read_springs(const Json& value, const std::string& where, InputFaults& faults) {
  Design design;
  ObjectReader reader(value, where, faults);
  read_numbers(reader, "springs", design);
  reader.refuse_unknown_keys();
  return design;
}

Json design_json(const Design& design) {
  Json json = Json::object();
  for (const DesignNumber& one : kNumbers) {
    const std::optional<double>& said = design.*one.number;
    Json& block = one.block.empty() ? json : json[std::string(one.block)];
    block[std::string(one.key)] = or_null(said ? said : one.standard);
  }
  json["springs"]["preloads_n"] = preloads_json(design.other_preloads);
  json["hinges"]["kind"] = nullptr;
  for (const CreaseCutName& one : kCreaseCuts) {
    if (design.hinge_kind == one.cut) json["hinges"]["kind"] = one.name;
  }
  json["hinges"]["film"] = design.film ? film_json(*design.film) : Json();
  json["material"] = design.material ? material_json(*design.material) : Json();
  json["hold"] = or_null(design.hold);
  json["gravity"] = or_null(design.gravity);
  return json;
}

Json explicit_design_json(const Design& design) {
  static const Json kNothing = design_json({});
  Json json = design_json(design);
  const auto leave_out = [](Json& object, const Json& standard) {
    for (auto it = object.begin(); it != object.end();) {
      it = *it == standard.at(it.key()) ? object.erase(it) : std::next(it);
    }
  };
  for (const std::string_view block : kBlocks) {
    const std::string name(block);
    leave_out(json[name], kNothing.at(name));
    if (json[name].empty()) json[name] = kNothing.at(name);
  }
  leave_out(json, kNothing);
  return json;
}

}  // namespace misalign::schema
