#include "schema/pattern_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "solver/perforation.hpp"

namespace misalign::schema {
namespace {

constexpr double kMostSide = 40;  // 3,900 unknowns: a dense Jacobian of 120 MB
constexpr double kLeastLength_mm = 1e-3, kMostLength_mm = 1e6;

void read_shape(ObjectReader& reader, solver::MiuraShape& shape) {
  std::string family = "miura";
  reader.require("family", "write \"miura\"");
  reader.text("family", family, "write \"miura\"");
  if (family != "miura") {
    reader.faults().add(reader.shown("family"), "is no pattern family", "write \"miura\"");
  }
  const auto side = [&](const char* key, int& into) {
    reader.require(key, "write how many panels, for example 6");
    const Json* value = reader.find(key);
    if (!value) return;
    if (!value->is_number_integer()) {
      reader.faults().add(reader.shown(key), "must be a whole number", "try 6");
    } else if (const double n = value->get<double>(); n < 3) {
      reader.faults().add(reader.shown(key),
                          "must be at least 3: only panels away from the border can be taken out",
                          "try 6");
    } else if (n > kMostSide) {
      reader.faults().add(reader.shown(key), "must be at most " + shown_number(kMostSide), "try 6");
    } else {
      into = static_cast<int>(n);
    }
  };
  side("rows", shape.rows);
  side("columns", shape.columns);
  reader.number("panel_width_mm", shape.panel_width_mm, kLeastLength_mm, kMostLength_mm, "try 80");
  reader.number("panel_height_mm", shape.panel_height_mm, kLeastLength_mm, kMostLength_mm,
                "try 80");
  reader.number("zigzag_offset_mm", shape.zigzag_offset_mm, kLeastLength_mm, kMostLength_mm,
                "try half of the panel width");
}

std::vector<int> read_holes(ObjectReader& reader, const solver::MiuraShape& shape) {
  const char* const kForms =
      "write \"checkerboard-odd\", \"checkerboard-even\" or a list of [row, column]";
  const Json* value = reader.find("holes");
  if (!value || *value == "checkerboard-odd") return solver::checkerboard(shape, 1);
  if (*value == "checkerboard-even") return solver::checkerboard(shape, 0);
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
    const double r = hole[0].get<double>(), c = hole[1].get<double>();
    if (!(r >= 0 && r < shape.rows && c >= 0 && c < shape.columns)) {
      reader.faults().add(reader.name("holes") + " has " + hole.dump(),
                          "the sheet has rows 0 to " + std::to_string(shape.rows - 1) +
                              " and columns 0 to " + std::to_string(shape.columns - 1),
                          "rows and columns count from 0");
      continue;
    }
    holes.push_back(static_cast<int>(r) * shape.columns + static_cast<int>(c));
  }
  std::sort(holes.begin(), holes.end());
  if (std::adjacent_find(holes.begin(), holes.end()) != holes.end()) {
    reader.faults().add(reader.name("holes"), "names a facet twice", "name each once");
  }
  return holes;
}

// Counting first, then the rank of the Jacobian, which has the last word.
void check_mobility(const std::string& where, const Pattern& pattern, InputFaults& faults) {
  const solver::PerforatedSheet& base = pattern.base;
  const auto hole_faults = solver::hole_faults(base.sheet, base.holes);
  for (const std::string& fault : hole_faults) {
    faults.add(where, fault, "take out inner panels that meet at corners only");
  }
  if (!hole_faults.empty()) return;
  const int counted = solver::counted_mobility(base.sheet, base.holes);
  const int inner = (pattern.shape.rows - 2) * (pattern.shape.columns - 2);
  if (base.holes.empty()) {
    faults.add(where, "there is no hole, so there is no diagonal to measure",
               "take out " + std::to_string(inner / 2) + " inner panels");
    return;
  }
  const solver::Mobility measured = solver::measured_mobility(base.sheet, base.holes, base.folding);
  if (measured.rank == measured.equations && measured.degrees_of_freedom() == 1) return;
  const std::string numbers = "the Jacobian has rank " + std::to_string(measured.rank) + " with " +
                              std::to_string(measured.unknowns) + " unknowns and " +
                              std::to_string(measured.equations) +
                              " equations; counting (2.1) gives " + std::to_string(counted);
  const bool odd = pattern.shape.rows % 2 == 1 || pattern.shape.columns % 2 == 1;
  const std::string suggestion = odd ? "make rows and columns even"
                                     : "take out " + std::to_string(inner / 2) +
                                           " of the inner panels, for example \"checkerboard-odd\"";
  if (measured.rank < measured.equations && measured.degrees_of_freedom() == 1) {
    faults.add(where,
               "the perforation leaves too many constraints, so that shifted sheets do not fold: " +
                   numbers,
               suggestion);
  } else {
    faults.add(where,
               "the perforation leaves " + std::to_string(measured.degrees_of_freedom()) +
                   " degrees of freedom, not 1: " + numbers,
               suggestion);
  }
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
    } else if (!shift.is_array() || shift.size() != 2 || !shift[0].is_number() ||
               !shift[1].is_number()) {
      reader.faults().add(name + "." + label + " = " + shift.dump(), "must be two numbers, x and y",
                          "write [0.4, 0.0]");
      good = false;
    } else {
      pattern.shifts_mm.col(vertex) =
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
                     InputFaults& faults) {
  Pattern pattern;
  ObjectReader reader(value, where, faults);
  const std::size_t before = faults.sentences().size();
  read_shape(reader, pattern.shape);
  const bool shape_good = faults.sentences().size() == before;
  std::vector<int> holes = read_holes(reader, pattern.shape);
  if (shape_good && faults.sentences().size() == before) {
    pattern.base.sheet = solver::miura_sheet(pattern.shape);
    pattern.base.folding = solver::miura_folding(pattern.shape, pattern.base.sheet);
    pattern.base.holes = std::move(holes);
    pattern.shifts_mm.setZero(2, pattern.base.sheet.vertex_count());
    check_mobility(reader.name("holes"), pattern, faults);
    if (displacements == Displacements::allowed) read_displacements(reader, pattern);
  } else if (displacements == Displacements::allowed) {
    reader.find("displacements_mm");  // not judged on a sheet that is refused, but a known key
  }
  if (displacements == Displacements::refused && reader.find("displacements_mm")) {
    faults.add(reader.name("displacements_mm"), "a campaign draws its own displacements",
               "take it out, or give the pattern to `misalign fold`");
  }
  reader.refuse_unknown_keys();
  return pattern;
}

Pattern read_pattern_file(const std::string& path) {
  InputFaults faults;
  Pattern pattern = read_pattern(read_json_file(path), "", Displacements::allowed, faults);
  faults.refuse(path);
  return pattern;
}

Json pattern_json(const Pattern& base, const Eigen::Matrix2Xd& shifts_mm) {
  Json holes = Json::array();
  if (base.base.holes == solver::checkerboard(base.shape, 1)) {
    holes = "checkerboard-odd";
  } else if (base.base.holes == solver::checkerboard(base.shape, 0)) {
    holes = "checkerboard-even";
  } else {
    for (const int f : base.base.holes) holes.push_back(facet_json(base, f));
  }
  Json json = {{"family", "miura"},
               {"rows", base.shape.rows},
               {"columns", base.shape.columns},
               {"panel_width_mm", base.shape.panel_width_mm},
               {"panel_height_mm", base.shape.panel_height_mm},
               {"zigzag_offset_mm", base.shape.zigzag_offset_mm},
               {"holes", holes}};
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

Json facet_json(const Pattern& pattern, int facet) {
  return {facet / pattern.shape.columns, facet % pattern.shape.columns};
}

int vertex_of_label(const std::string& label, int vertex_count) {
  int number = 0;
  const char* const end = label.data() + label.size();
  if (label.size() < 2 || label[0] != 'A' || label[1] == '0') return -1;
  const auto [stop, error] = std::from_chars(label.data() + 1, end, number);
  if (error != std::errc{} || stop != end || number < 1 || number > vertex_count) return -1;
  return number - 1;
}

}  // namespace misalign::schema
