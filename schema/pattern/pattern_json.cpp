#include "schema/pattern/pattern_json.hpp"

#include <algorithm>

#include "schema/files/json_values.hpp"
#include "schema/pattern/fold_format.hpp"
#include "schema/pattern/mesh_base.hpp"
#include "schema/pattern/mesh_family.hpp"
#include "schema/pattern/spring_ends_json.hpp"
#include "schema/pattern/vertex_labels.hpp"

namespace misalign::schema {
namespace {

std::vector<int> read_holes(ObjectReader& reader, const FamilyMesh& mesh) {
  const char* const kForms =
      "write \"checkerboard-odd\", \"checkerboard-even\" or a list of [row, column]";
  const Json* value = reader.find("holes");
  if (value && !mesh.missing.empty()) {
    reader.faults().add(reader.name("holes"), "the file lacks faces already, which are the holes",
                        "take the key out, or give the file all of its faces");
    return mesh.missing;
  }
  if (!value && !mesh.missing.empty()) return mesh.missing;
  if (!value || *value == "checkerboard-odd") return solver::checkerboard(mesh.sheet, 1);
  if (*value == "checkerboard-even") return solver::checkerboard(mesh.sheet, 0);
  if (!value->is_array()) {
    reader.faults().add(reader.shown("holes"), "is no perforation", kForms);
    return {};
  }
  std::vector<int> holes;
  for (const Json& hole : *value) {
    if (!hole.is_array() || hole.size() != 2 || !hole[0].is_number_integer() ||
        !hole[1].is_number_integer()) {
      reader.faults().add(reader.name("holes") + " has " + hole.dump(), "is no facet", kForms);
      continue;
    }
    const double row = hole[0].get<double>(), column = hole[1].get<double>();
    const auto at =
        std::find_if(mesh.sheet.places.begin(), mesh.sheet.places.end(),
                     [&](const auto& place) { return place[0] == row && place[1] == column; });
    if (at == mesh.sheet.places.end()) {
      int last_row = 0, last_column = 0;
      for (const auto& place : mesh.sheet.places) {
        last_row = std::max(last_row, place[0]);
        last_column = std::max(last_column, place[1]);
      }
      reader.faults().add(reader.name("holes") + " has " + hole.dump(),
                          "the sheet has rows 0 to " + std::to_string(last_row) +
                              " and columns 0 to " + std::to_string(last_column),
                          "rows and columns count from 0");
      continue;
    }
    holes.push_back(static_cast<int>(at - mesh.sheet.places.begin()));
  }
  std::sort(holes.begin(), holes.end());
  if (std::adjacent_find(holes.begin(), holes.end()) != holes.end()) {
    reader.faults().add(reader.name("holes"), "names a facet twice", "name each once");
  }
  return holes;
}

// Creases that may be the pilot of a sheet whose file names none: the default, then the others.
std::vector<int> usual_pilots(const solver::CreasePattern& sheet, const std::vector<int>& holes) {
  const auto is_open = [&](int f) { return f < 0 || std::ranges::binary_search(holes, f); };
  std::vector<int> pilots{solver::default_pilot(sheet, holes)};
  for (int e = 0; e < std::ssize(sheet.edges); ++e) {
    const solver::Edge& edge = sheet.edges[static_cast<std::size_t>(e)];
    if (!is_open(edge.left) && !is_open(edge.right) && e != pilots.front()) pilots.push_back(e);
  }
  return pilots;
}

// Reads the pilot's edge, of which there are several to choose from if none is named; -1 after a
// fault.
std::vector<int> read_pilots(ObjectReader& reader, const solver::CreasePattern& sheet,
                             const std::vector<int>& holes) {
  const int usual = solver::default_pilot(sheet, holes);
  const Json* value = reader.find("pilot");
  if (!value) return usual_pilots(sheet, holes);
  const auto refuse = [&](const char* why) {
    reader.faults().add(
        reader.shown("pilot"), why,
        usual < 0 ? "take it out"
                  : "write a crease as \"" +
                        solver::line_label(sheet.edges[usual].a, sheet.edges[usual].b) + "\"");
    return std::vector<int>{-1};
  };
  const std::string text = value->is_string() ? value->get<std::string>() : "";
  const auto dash = text.find('-');
  if (dash == std::string::npos) return refuse("names no crease");
  const int a = vertex_of_label(text.substr(0, dash), sheet.vertex_count());
  const int b = vertex_of_label(text.substr(dash + 1), sheet.vertex_count());
  const int e = a < 0 || b < 0 ? -1 : solver::find_edge(sheet, a, b);
  if (e < 0) return refuse("is no edge of this sheet");
  const solver::Edge& edge = sheet.edges[e];
  const auto is_open = [&](int f) {
    return f < 0 || std::binary_search(holes.begin(), holes.end(), f);
  };
  if (is_open(edge.left) || is_open(edge.right)) return refuse("does not join two panels");
  return {e};
}

void read_displacements(ObjectReader& reader, Pattern& pattern) {
  const Json* value = reader.find("displacements_mm");
  if (!value) return;
  const std::string name = reader.name("displacements_mm");
  if (!value->is_object()) {
    reader.faults().add(name, "must be an object", "write {\"A10\": [0.4, 0.0]}");
    return;
  }
  bool good = true;
  for (const auto& [label, shift] : value->items()) {
    const int vertex = vertex_of_label(label, pattern.base.sheet.vertex_count());
    if (vertex < 0) {
      reader.faults().add(
          name + "." + label, "is no vertex of this sheet",
          "vertices are A1 to A" + std::to_string(pattern.base.sheet.vertex_count()));
      good = false;
    } else if (!are_numbers(shift, 2)) {
      reader.faults().add(name + "." + label + " = " + shift.dump(), "must be two numbers, x and y",
                          "write [0.4, 0.0]");
      good = false;
    } else {
      pattern.shifts_mm.col(vertex) +=
          Eigen::Vector2d(shift[0].get<double>(), shift[1].get<double>());
    }
  }
  const auto bad = solver::nonconvex_facets(pattern.base.sheet, pattern.vertices_mm());
  if (good && !bad.empty()) {
    reader.faults().add(name,
                        "they turn the facet " + facet_json(pattern, bad.front()).dump() +
                            " into no convex quadrilateral",
                        "shift vertices by a small part of a panel");
  }
}

}  // namespace

Pattern read_pattern(const Json& value, const std::string& where, Displacements displacements,
                     const std::optional<std::filesystem::path>& directory, InputFaults& faults,
                     Perforations perforations) {
  Pattern pattern;
  const std::size_t before = faults.count();
  ObjectReader reader(value, where, faults);
  const auto good = [&] { return faults.count() == before; };
  FamilyMesh mesh = read_family(reader, directory);
  if (good()) {
    pattern.base.holes = read_holes(reader, mesh);
    for (const std::string& fault : solver::hole_faults(mesh.sheet, pattern.base.holes)) {
      faults.add(reader.name("holes"), fault, "take out inner panels that meet at corners only");
    }
  }
  std::vector<int> pilots;
  if (good()) pilots = read_pilots(reader, mesh.sheet, pattern.base.holes);
  if (good()) {
    pattern.base.sheet = std::move(mesh.sheet);
    pattern.shifts_mm.setZero(2, pattern.base.sheet.vertex_count());
    fold_base(mesh, pilots, displacements, pattern, faults);
  }
  if (good()) {
    pattern.family = std::move(mesh.family);
    if (pattern.family["family"] == "fold") {
      const solver::BaseFolding& folding = pattern.base.folding;
      std::vector<int> assignment = folding.assignment();
      for (int& sign : assignment) sign *= folding.side();
      pattern.family["mesh"] = fold_json(pattern.base.sheet, assignment);
      if (pattern.folded_target)
        add_folded_form(pattern.folded_target->vertices_mm, pattern.family["mesh"]);
    }
  }
  if (good()) read_spring_ends(reader, pattern);
  if (good() && displacements == Displacements::allowed) read_displacements(reader, pattern);
  if (good() && perforations != Perforations::any) {
    check_perforation(reader.name("holes"), pattern, perforations, faults);
  }
  if (displacements == Displacements::refused && reader.find("displacements_mm")) {
    faults.add(reader.name("displacements_mm"), "a campaign draws its own displacements",
               "take it out, or give the pattern to `misalign fold`");
  }
  // Known keys, but not judged on a refused sheet.
  for (const char* key : {"holes", "pilot", "springs", "displacements_mm"}) {
    if (!good()) reader.find(key);
  }
  reader.refuse_unknown_keys();
  return pattern;
}

Json pattern_json(const Pattern& base, const Eigen::Matrix2Xd& shifts_mm) {
  const solver::CreasePattern& sheet = base.base.sheet;
  Json json = base.family;
  if (base.base.holes == solver::checkerboard(sheet, 1)) {
    json["holes"] = "checkerboard-odd";
  } else if (base.base.holes == solver::checkerboard(sheet, 0)) {
    json["holes"] = "checkerboard-even";
  } else {
    json["holes"] = json_list(base.base.holes, [&](int f) { return facet_json(base, f); });
  }
  const int pilot = base.base.folding.pilot_edge();
  if (pilot != solver::default_pilot(sheet, base.base.holes)) {
    json["pilot"] = solver::line_label(sheet.edges[pilot].a, sheet.edges[pilot].b);
  }
  if (!base.base.springs.at_vertices()) json["springs"] = spring_ends_json(base);
  const Json displacements = displacements_json(shifts_mm);
  if (!displacements.empty()) json["displacements_mm"] = displacements;
  return json;
}

Json displacements_json(const Eigen::Matrix2Xd& shifts_mm) {
  Json shifts = Json::object();
  for (int v = 0; v < shifts_mm.cols(); ++v) {
    if (shifts_mm(0, v) != 0 || shifts_mm(1, v) != 0) {
      shifts[solver::vertex_label(v)] = {shifts_mm(0, v), shifts_mm(1, v)};
    }
  }
  return shifts;
}

}  // namespace misalign::schema
