#include "schema/pattern/design_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "schema/files/json_values.hpp"
#include "schema/pattern/design_numbers.hpp"
#include "schema/pattern/fill_json.hpp"
#include "schema/pattern/joint_kind.hpp"
#include "solver/pattern/outline.hpp"

namespace misalign::schema {
namespace {

constexpr std::string_view kBlocks[] = {"hinges", "joints", "wanted"};

// Numbers of springs that files with "actuators" can have.
constexpr std::string_view kOlderNumbers[] = {"stiffness_n_per_mm", "stroke_limit", "preload_n",
                                              "largest_force_n"};

const Json& part_of(ObjectReader& reader, const char* key) {
  static const Json kEmpty = Json::object();
  const Json* found = reader.find(key);
  return found ? *found : kEmpty;
}

// Returns the row of the hinge table that "like" names; null, also with a fault, if it names none.
const HingeRow* read_like(ObjectReader& reader) {
  const Json* like = reader.said("like");
  if (!like) return nullptr;
  const std::string typed = like->is_string() ? like->get<std::string>() : "";
  const HingeRow* row = find_hinge(typed);
  if (!row) {
    const solver::OptionFault fault = unknown_hinge(typed);
    reader.faults().add(reader.shown("like"), fault.why, fault.suggestion);
  }
  return row;
}

// Reads a film; `like` has the values that it does not say.
void read_film(ObjectReader& reader, const std::optional<solver::FilmHinge>& like,
               std::optional<solver::FilmHinge>& film) {
  constexpr double kMost = 1e6;
  const Json* value = reader.said("film");
  if (!value) return;
  solver::FilmHinge read = like.value_or(solver::FilmHinge{0, 0, 0});
  ObjectReader part(*value, reader.name("film"), reader.faults());
  for (const char* key : {"thickness_mm", "e_gpa", "length_mm"}) {
    if (!like) part.require(key, R"(write {"thickness_mm": 0.05, "e_gpa": 2.5, "length_mm": 1})");
  }
  part.number("thickness_mm", read.thickness_mm, 1e-6, kMost, "try 0.05");
  part.number("e_gpa", read.e_gpa, 1e-6, kMost, "give Young's modulus in GPa, 2.5 of polyimide");
  part.number("length_mm", read.length_mm, 1e-6, kMost, "write the film's free length, such as 1");
  part.number("loss", read.loss, 0, 1, "write the loss factor, such as 0.01, or 0");
  part.refuse_unknown_keys();
  film = read;
}

// Reads what a block "hinges" holds beside its numbers.
void read_hinges(ObjectReader& reader, Design& design) {
  const HingeRow* like = read_like(reader);
  read_crease(reader, "kind", design.hinge_kind);
  read_film(reader, like ? like->film : std::nullopt, design.film);
  if (like) design.take_hinge(*like);
  if (!reader.said("name")) return;
  reader.text("name", design.hinge_name.emplace(), "name the hinges, such as \"glued textile\"");
}

// Reads an array of the size of `into`; none if it is null.
template <class Array>
void read_array(ObjectReader& reader, const char* key, std::optional<Array>& into,
                const auto& is_one, const char* why, const char* suggestion) {
  const Json* value = reader.said(key);
  if (!value) return;
  if (value->is_array() && value->size() == Array().size() && std::ranges::all_of(*value, is_one)) {
    into = value->get<Array>();
  } else {
    reader.faults().add(reader.shown(key), why, suggestion);
  }
}

bool is_gravity(const Json& number) {
  constexpr double kMostGravities = 1e3;
  return number.is_number() && std::abs(number.get<double>()) <= kMostGravities;
}

}  // namespace

Design read_design(const Json& value, const std::string& where, InputFaults& faults) {
  Design design;
  ObjectReader reader(value, where, faults);
  read_numbers(reader, "", design);
  read_fill(reader, design);
  for (const std::string_view block : kBlocks) {
    const std::string name(block);
    ObjectReader part(part_of(reader, name.c_str()), reader.name(name), faults);
    read_numbers(part, block, design);
    if (block == "hinges") read_hinges(part, design);
    if (block == "joints") read_joint_kind(part, "kind", design.joint_kind);
    part.refuse_unknown_keys();
  }
  if (const Json* material = reader.said("material")) {
    design.material = read_material(*material, reader.name("material"), "the design's", faults);
  }
  read_array(reader, "hold", design.hold, is_place, "is no panel, row and column counted from 0",
             "write [0, 0], or null for a sheet that is free in space");
  if (reader.find("hold_flat")) {
    reader.boolean("hold_flat", design.hold_flat.emplace(),
                   "write true where a stop, latch or frame holds the sheet at flat, or false");
  }
  read_array(reader, "gravity", design.gravity, is_gravity,
             "must be three numbers of standard gravities, from -1000 to 1000",
             "write [0, 0, -1], or null for no weight");
  reader.refuse_unknown_keys();
  return design;
}

Design read_springs(const Json& value, const std::string& where, InputFaults& faults) {
  Design design;
  ObjectReader reader(value, where, faults);
  for (const DesignNumber& row : design_numbers()) {
    const bool is_older = std::ranges::find(kOlderNumbers, row.key) != std::end(kOlderNumbers);
    if (row.block == "springs" && is_older) read_number(reader, row, design);
  }
  reader.refuse_unknown_keys();
  return design;
}

Json design_json(const Design& design) {
  Json json = numbers_json(design, "");
  for (const std::string_view block : kBlocks) {
    json[std::string(block)] = numbers_json(design, block);
  }
  if (design.is_springs()) {
    json["springs"] = springs_json(design);
  } else {
    json["fill"] = fill_json(design);
  }
  json["joints"]["kind"] = joint_kind_json(design.joint_kind);
  json["hinges"]["kind"] = crease_json(design.hinge_kind);
  if (design.hinge_name) json["hinges"]["name"] = *design.hinge_name;
  json["hinges"]["film"] = design.film ? film_json(*design.film) : Json();
  json["material"] = design.material ? material_json(*design.material) : Json();
  json["hold"] = or_null(design.hold);
  json["hold_flat"] = design.hold_flat.value_or(false);
  json["gravity"] = or_null(design.gravity);
  return json;
}

Json explicit_design_json(const Design& design) {
  static const Json kNothing = design_json({});
  Json json = design_json(design);
  leave_out_defaults(json, kNothing);
  // Zeros that a design says go before the values of its film.
  for (const DesignNumber& row : design_numbers()) {
    const std::optional<double>& value = design.*row.number;
    if (design.film && value && row.block == "hinges") json["hinges"][row.key] = *value;
  }
  return json;
}

void check_names(const Design& design, const solver::PerforatedSheet& base,
                 const std::string& source) {
  InputFaults faults;
  find_fill_faults(design, base, design.fill_key(), faults);
  const auto is_held = [&](int facet) {
    const auto& place = base.sheet.places[static_cast<std::size_t>(facet)];
    return place[0] == design.hold->at(0) && place[1] == design.hold->at(1);
  };
  if (design.hold && std::ranges::none_of(solver::kept_facets(base.sheet, base.holes), is_held)) {
    faults.add(fmt::format("hold = [{}, {}]", design.hold->at(0), design.hold->at(1)),
               "is no panel of this sheet; rows and columns count from 0, and holes cannot be held",
               "name one such as [0, 0], or write null");
  }
  faults.refuse(source + ": design");
}

}  // namespace misalign::schema
