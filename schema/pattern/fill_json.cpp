#include "schema/pattern/fill_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "schema/files/json_values.hpp"
#include "schema/pattern/design_numbers.hpp"
#include "schema/pattern/preload_json.hpp"
#include "schema/pattern/vertex_labels.hpp"
#include "solver/kinematics/mechanism.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {
namespace {

constexpr char kSingleForm[] =
    R"(write [{"from": "A10", "to": "A16", "stiffness_n_per_mm": 12, "free_mm": null}])";
constexpr char kCutOutForm[] = R"(write [{"hole": [1, 2], "of_flat": [0.9, 0.95]}])";

struct SpringsOnName {
  const char* name;
  solver::SpringsOn on;
};
constexpr SpringsOnName kSpringsOn[] = {{"all", solver::SpringsOn::all},
                                        {"one_a_hole", solver::SpringsOn::one_a_hole}};

// Reads each element of a list that may be null.
void read_each(ObjectReader& reader, const char* key, const char* form, const auto& read_one) {
  const Json* const list = reader.said(key);
  if (!list) return;
  if (!list->is_array()) return reader.faults().add(reader.shown(key), "must be a list", form);
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::size_t before = reader.faults().count();
    ObjectReader element((*list)[i], fmt::format("{}[{}]", reader.name(key), i), reader.faults());
    read_one(element, before);
    element.refuse_unknown_keys();
  }
}

int read_vertex(ObjectReader& spring, const char* key) {
  constexpr int kAnyVertex = 1 << 24;  // the sheet knows which exist
  spring.require(key, kSingleForm);
  const Json* const label = spring.find(key);
  if (!label) return -1;
  const int vertex =
      label->is_string() ? vertex_of_label(label->get<std::string>(), kAnyVertex) : -1;
  if (vertex < 0) spring.faults().add(spring.shown(key), "is no vertex", kSingleForm);
  return vertex;
}

void read_single_springs(ObjectReader& reader, std::vector<solver::SingleSpring>& springs) {
  const double most = design_limits("springs.stiffness_n_per_mm").most;
  read_each(reader, "single", kSingleForm, [&](ObjectReader& element, std::size_t before) {
    solver::SingleSpring spring{};
    spring.from = read_vertex(element, "from");
    spring.to = read_vertex(element, "to");
    element.require("stiffness_n_per_mm", kSingleForm);
    element.number("stiffness_n_per_mm", spring.stiffness_n_per_mm, 0, most,
                   "write the spring's rate, 0 for a diagonal without one");
    element.number("free_mm", spring.free_mm, 1e-6, 1e6,
                   "write the length without force, or null for the rest of the others");
    if (reader.faults().count() == before) springs.push_back(spring);
  });
}

void read_cut_outs(ObjectReader& reader, std::vector<DesignFill::CutOut>& cut_outs) {
  const auto are_places = [](const Json& value) {
    return value.is_array() && value.size() == 2 && std::ranges::all_of(value, is_place);
  };
  const auto are_shares = [](const Json& value) {
    return are_numbers(value, 2) && std::ranges::all_of(value, [](const Json& x) {
             return x.get<double>() >= 0.1 && x.get<double>() <= 10;
           });
  };
  read_each(reader, "cut_outs", kCutOutForm, [&](ObjectReader& element, std::size_t before) {
    const auto check = [&](const char* key, const auto& is_right, const char* why) {
      element.require(key, kCutOutForm);
      const Json* const value = element.find(key);
      if (value && !is_right(*value)) element.faults().add(element.shown(key), why, kCutOutForm);
    };
    check("hole", are_places, "is no row and column");
    check("of_flat", are_shares, "must be two numbers from 0.1 to 10");
    if (reader.faults().count() > before) return;
    cut_outs.push_back({element.find("hole")->get<std::array<int, 2>>(),
                        element.find("of_flat")->get<std::array<double, 2>>()});
  });
}

void read_springs_into(ObjectReader& reader, Design& design) {
  read_numbers(reader, "springs", design);
  read_preloads(reader, design.other_preloads);
  if (reader.find("pull_only")) {
    reader.boolean("pull_only", design.pull_only.emplace(), "write true of wires, or false");
  }
  const auto* const on =
      read_name(reader, "on", kSpringsOn, "does not say which diagonals have springs",
                R"(write "all", or "one_a_hole" for the diagonal that lengthens)");
  if (on) design.springs_on = on->on;
  read_single_springs(reader, design.single_springs);
}

void read_kind(ObjectReader& reader, Design& design) {
  const auto* const kind = read_name(reader, "kind", kFillKinds, "is no filling of a hole",
                                     R"(write "springs", "plate" or "none")");
  if (!kind) return;
  design.fill_kind = kind->kind;
  if (kind->kind == FillKind::springs) read_springs_into(reader, design);
  if (kind->kind == FillKind::plate) {
    read_numbers(reader, "plate", design);
    read_cut_outs(reader, design.cut_outs);
  }
  reader.refuse_unknown_keys();
}

const char* name_of(solver::SpringsOn on) {
  return std::ranges::find(kSpringsOn, on, &SpringsOnName::on)->name;
}

Json single_json(const solver::SingleSpring& spring) {
  return {{"from", solver::vertex_label(spring.from)},
          {"to", solver::vertex_label(spring.to)},
          {"stiffness_n_per_mm", spring.stiffness_n_per_mm},
          {"free_mm", or_null(spring.free_mm)}};
}

Json list_or_null(const Json& list) { return list.empty() ? Json() : list; }

// Adds a fault for each that is no diagonal of the sheet, or that is named before.
void find_diagonal_faults(const std::vector<solver::DiagonalEnds>& named,
                          const solver::Mechanism& mechanism, const std::string& where,
                          InputFaults& faults) {
  for (std::size_t k = 0; k < named.size(); ++k) {
    const std::string name = where + solver::line_label(named[k].from, named[k].to);
    const auto is_it = [&](const solver::Diagonal& diagonal) { return named[k].is_on(diagonal); };
    const auto at = std::ranges::find_if(mechanism.diagonals, is_it);
    if (at == mechanism.diagonals.end()) {
      const solver::Diagonal& first = mechanism.diagonals.front();
      faults.add(name, "is no diagonal of a hole of this sheet",
                 "name one such as " + solver::line_label(first.from, first.to));
    } else if (std::any_of(named.begin(), named.begin() + static_cast<std::ptrdiff_t>(k),
                           [&](const auto& before) { return before.is_on(*at); })) {
      faults.add(name, "is named twice, perhaps by its vertices in the other order",
                 "name it once");
    }
  }
}

// Adds a fault for each that is no hole of the sheet, or that is named before.
void find_hole_faults(const std::vector<DesignFill::CutOut>& cut_outs,
                      const solver::PerforatedSheet& base, const std::string& where,
                      InputFaults& faults) {
  std::set<std::array<int, 2>> named;
  for (const DesignFill::CutOut& cut_out : cut_outs) {
    const std::string name = where + Json(cut_out.hole).dump();
    if (hole_at(base, cut_out.hole) < 0) {
      const auto first = static_cast<std::size_t>(base.holes.front());
      faults.add(name, "is no hole of this sheet; rows and columns count from 0",
                 "name one such as " + Json(base.sheet.places[first]).dump());
    } else if (!named.insert(cut_out.hole).second) {
      faults.add(name, "is named twice", "name it once");
    }
  }
}

}  // namespace

void read_fill(ObjectReader& reader, Design& design) {
  static const Json kEmpty = Json::object();
  const Json* const springs = reader.find("springs");
  ObjectReader part(springs ? *springs : kEmpty, reader.name("springs"), reader.faults());
  read_springs_into(part, design);
  part.refuse_unknown_keys();
  const Json* const fill = reader.find("fill");
  if (!fill) return;
  if (springs) {
    return reader.faults().add(reader.name("fill"), "is given beside " + reader.name("springs"),
                               "write one of them: springs are a filling, too");
  }
  static_cast<DesignFill&>(design) = read_fill(*fill, reader.name("fill"), reader.faults());
}

Design read_fill(const Json& value, const std::string& where, InputFaults& faults) {
  Design design;
  ObjectReader reader(value, where, faults);
  reader.require("kind", R"(write "springs", "plate" or "none")");
  read_kind(reader, design);
  return design;
}

std::optional<solver::Fill> read_fill_of(const solver::PerforatedSheet& base, const Json& value,
                                         const std::string& where, InputFaults& faults) {
  const std::size_t before = faults.count();
  const Design design = read_fill(value, where, faults);
  for (const DesignNumber& row : design_numbers()) {
    const bool is_limit = row.block == "springs" && !row.standard;
    if (!is_limit || !(design.*row.number)) continue;
    faults.add(where + "." + std::string(row.key), "changes no energy, and is judged by studies",
               "write it in design.fill");
  }
  if (faults.count() == before) find_fill_faults(design, base, where, faults);
  if (faults.count() > before) return std::nullopt;
  return design.fill(base);
}

Json springs_json(const Design& design) {
  Json json = numbers_json(design, "springs");
  json["preloads_n"] = preloads_json(design.other_preloads);
  json["pull_only"] = design.pull_only.value_or(false);
  json["on"] = name_of(design.springs_on.value_or(solver::SpringsOn::all));
  json["single"] = list_or_null(json_list(design.single_springs, single_json));
  return json;
}

Json fill_json(const Design& design) {
  if (design.fill_kind == FillKind::none) return {{"kind", "none"}};
  Json json = design.is_plate() ? numbers_json(design, "plate") : springs_json(design);
  json["kind"] = design.is_plate() ? "plate" : "springs";
  if (design.is_plate()) {
    json["cut_outs"] = list_or_null(json_list(design.cut_outs, [](const auto& cut_out) {
      return Json{{"hole", cut_out.hole}, {"of_flat", cut_out.of_flat}};
    }));
  }
  return json;
}

Json fill_json(const solver::Fill& fill, const solver::PerforatedSheet& base) {
  Design design;
  static_cast<DesignFill&>(design) = design_of(fill, base);
  Json json = fill_json(design);
  for (const DesignNumber& row : design_numbers()) {
    if (row.block == "springs" && !row.standard) json.erase(std::string(row.key));
  }
  return json;
}

void add_single_springs(const solver::Springs& springs, Json& json) {
  if (springs.on != solver::SpringsOn::all) json["on"] = name_of(springs.on);
  if (!springs.single.empty()) json["single"] = json_list(springs.single, single_json);
}

void find_fill_faults(const DesignFill& design, const solver::PerforatedSheet& base,
                      const std::string& where, InputFaults& faults) {
  const auto& preloads = design.other_preloads;
  const auto& springs = design.single_springs;
  if (!preloads.empty() || !springs.empty()) {
    const solver::Mechanism mechanism = solver::build_mechanism(base);
    find_diagonal_faults({preloads.begin(), preloads.end()}, mechanism, where + ".preloads_n.",
                         faults);
    find_diagonal_faults({springs.begin(), springs.end()}, mechanism, where + ".single ", faults);
  }
  find_hole_faults(design.cut_outs, base, where + ".cut_outs ", faults);
}

void check_fill(const DesignFill& design, const solver::PerforatedSheet& base) {
  InputFaults faults;
  find_fill_faults(design, base, design.fill_key(), faults);
  faults.refuse("design");
}

}  // namespace misalign::schema
