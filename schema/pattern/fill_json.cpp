#include "schema/pattern/fill_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
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

// Returns the row with the name that a key holds; none, with a fault, if no row has it.
template <class Row, std::size_t kCount>
const Row* named(ObjectReader& reader, const char* key, const Row (&rows)[kCount], const char* why,
                 const char* suggestion) {
  const Json* const value = reader.find(key);
  if (!value) return nullptr;
  const auto* const at =
      std::ranges::find_if(rows, [&](const Row& row) { return *value == row.name; });
  if (at != std::end(rows)) return at;
  reader.faults().add(reader.shown(key), why, suggestion);
  return nullptr;
}

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
  const auto is_place = [](const Json& value) {
    return value.is_array() && value.size() == 2 && std::ranges::all_of(value, [](const Json& x) {
             return x.is_number_integer() && x >= 0 && x < 1000;
           });
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
    check("hole", is_place, "is no row and column");
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
      named(reader, "on", kSpringsOn, "does not say which diagonals have springs",
            R"(write "all", or "one_a_hole" for the diagonal that lengthens)");
  if (on) design.springs_on = on->on;
  read_single_springs(reader, design.single_springs);
}

void read_kind(ObjectReader& reader, Design& design) {
  const auto* const kind = named(reader, "kind", kFillKinds, "is no filling of a hole",
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

Json list_or_null(Json list) { return list.empty() ? Json() : list; }

Design whole(const DesignFill& fill) {
  Design design;
  static_cast<DesignFill&>(design) = fill;
  return design;
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

DesignFill read_fill(const Json& value, const std::string& where, InputFaults& faults) {
  Design design;
  ObjectReader reader(value, where, faults);
  reader.require("kind", R"(write "springs", "plate" or "none")");
  read_kind(reader, design);
  return design;
}

std::optional<solver::Fill> read_fill_of(const solver::PerforatedSheet& base, const Json& value,
                                         const std::string& where, InputFaults& faults) {
  const std::size_t before = faults.count();
  const DesignFill fill = read_fill(value, where, faults);
  const Design design = whole(fill);
  for (const DesignNumber& row : design_numbers()) {
    const bool is_limit = row.block == "springs" && !row.standard;
    if (!is_limit || !(design.*row.number)) continue;
    faults.add(where + "." + std::string(row.key), "changes no energy, and is judged by studies",
               "write it in design.fill");
  }
  if (faults.count() == before) find_fill_faults(fill, base, where, faults);
  if (faults.count() > before) return std::nullopt;
  return fill.fill(base);
}

Json springs_json(const DesignFill& design) {
  Json json = numbers_json(whole(design), "springs");
  json["preloads_n"] = preloads_json(design.other_preloads);
  json["pull_only"] = design.pull_only.value_or(false);
  json["on"] = name_of(design.springs_on.value_or(solver::SpringsOn::all));
  json["single"] = list_or_null(json_list(design.single_springs, single_json));
  return json;
}

Json fill_json(const DesignFill& design) {
  if (design.fill_kind == FillKind::none) return {{"kind", "none"}};
  Json json = design.is_plate() ? numbers_json(whole(design), "plate") : springs_json(design);
  json["kind"] = design.is_plate() ? "plate" : "springs";
  if (design.is_plate()) {
    json["cut_outs"] = list_or_null(json_list(design.cut_outs, [](const auto& cut_out) {
      return Json{{"hole", cut_out.hole}, {"of_flat", cut_out.of_flat}};
    }));
  }
  return json;
}

Json fill_json(const solver::Fill& fill, const solver::PerforatedSheet& base) {
  Json json = fill_json(design_of(fill, base));
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
  const bool names_diagonals = !design.other_preloads.empty() || !design.single_springs.empty();
  const solver::Mechanism mechanism =
      names_diagonals ? solver::build_mechanism(base) : solver::Mechanism{};
  find_preload_faults(design.other_preloads, mechanism, where, faults);
  std::set<std::pair<int, int>> named_springs;
  for (const solver::SingleSpring& spring : design.single_springs) {
    const std::string name = where + ".single " + solver::line_label(spring.from, spring.to);
    const auto on_one = [&](const auto& diagonal) { return spring.is_on(diagonal); };
    if (std::ranges::none_of(mechanism.diagonals, on_one)) {
      const solver::Diagonal& first = mechanism.diagonals.front();
      faults.add(name, "is no diagonal of a hole of this sheet",
                 "name one such as " + solver::line_label(first.from, first.to));
    } else if (!named_springs.insert(std::minmax(spring.from, spring.to)).second) {
      faults.add(name, "is named twice", "name it once");
    }
  }
  std::set<std::array<int, 2>> named_holes;
  for (const DesignFill::CutOut& cut_out : design.cut_outs) {
    const std::string name = where + ".cut_outs " + Json(cut_out.hole).dump();
    if (hole_at(base, cut_out.hole) < 0) {
      const auto first = static_cast<std::size_t>(base.holes.front());
      faults.add(name, "is no hole of this sheet; rows and columns count from 0",
                 "name one such as " + Json(base.sheet.places[first]).dump());
    } else if (!named_holes.insert(cut_out.hole).second) {
      faults.add(name, "is named twice", "name it once");
    }
  }
}

void check_fill(const DesignFill& design, const solver::PerforatedSheet& base) {
  InputFaults faults;
  find_fill_faults(design, base, design.fill_key(), faults);
  faults.refuse("design");
}

}  // namespace misalign::schema
