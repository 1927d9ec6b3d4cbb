#include "schema/pattern/mesh_family.hpp"

#include <algorithm>

#include "schema/pattern/fold_format.hpp"
#include "schema/pattern/pattern_document.hpp"
#include "solver/pattern/miura.hpp"

namespace misalign::schema {
namespace {

constexpr int kMostSide = 80;  // results/large-sheets.md says what time and memory it takes
constexpr double kLeastLength_mm = 1e-3, kMostLength_mm = 1e6;

// Reads a length for all panels of a row or column, or a list with one for each.
void read_lengths(ObjectReader& reader, const char* key, double usual, int count,
                  const std::string& suggestion, std::vector<double>& lengths) {
  const Json* value = reader.find(key);
  if (!value || !value->is_array()) {
    reader.number(key, usual, kLeastLength_mm, kMostLength_mm, suggestion);
    lengths.assign(count, usual);
    return;
  }
  if (static_cast<int>(value->size()) != count) {
    reader.faults().add(reader.name(key) + " has " + std::to_string(value->size()) + " lengths",
                        "there must be one for each of " + std::to_string(count),
                        "write a list of that length, or one number");
  }
  for (const Json& length : *value) {
    const double number = length.is_number() ? length.get<double>() : 0;
    if (!(number >= kLeastLength_mm && number <= kMostLength_mm)) {
      reader.faults().add(reader.name(key) + " has " + length.dump(),
                          "must be a number from " + shown_number(kLeastLength_mm) + " to " +
                              shown_number(kMostLength_mm),
                          suggestion);
    }
    lengths.push_back(number);
  }
}

Json lengths_json(const std::vector<double>& lengths) {
  const bool equal =
      std::adjacent_find(lengths.begin(), lengths.end(), std::not_equal_to<>()) == lengths.end();
  return equal ? Json(lengths.front()) : Json(lengths);
}

// Reads the numbers of rows and columns.
void read_sides(ObjectReader& reader, int& rows, int& columns) {
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
      reader.faults().add(reader.shown(key), "must be at most " + std::to_string(kMostSide),
                          "try 6");
    } else {
      into = static_cast<int>(n);
    }
  };
  side("rows", rows);
  side("columns", columns);
}

FamilyMesh read_miura(ObjectReader& reader) {
  int rows = 6, columns = 6;
  const std::size_t before = reader.faults().count();
  read_sides(reader, rows, columns);
  solver::MiuraShape shape;
  read_lengths(reader, "panel_width_mm", 80, columns, "try 80", shape.width_mm);
  read_lengths(reader, "panel_height_mm", 80, rows, "try 80", shape.height_mm);
  read_lengths(reader, "zigzag_offset_mm", 40, rows, "try half of the panel width",
               shape.offset_mm);
  if (reader.faults().count() > before) return {};
  FamilyMesh mesh;
  mesh.family = {{"family", "miura"},
                 {"rows", rows},
                 {"columns", columns},
                 {"panel_width_mm", lengths_json(shape.width_mm)},
                 {"panel_height_mm", lengths_json(shape.height_mm)},
                 {"zigzag_offset_mm", lengths_json(shape.offset_mm)}};
  mesh.place = reader.name("family") + " = \"miura\"";
  mesh.sheet = solver::miura_sheet(shape);
  mesh.assignment = solver::miura_assignment(shape, mesh.sheet);
  return mesh;
}

// Reads a file in FOLD or OBJ, or its contents as "mesh", as in a catalogue.
FamilyMesh read_fold_mesh(ObjectReader& reader,
                          const std::optional<std::filesystem::path>& directory) {
  const Json* file = reader.find("file");
  const Json* inline_mesh = reader.find("mesh");
  for (const char* key : {"target_frame", "target_file"}) reader.find(key);  // known without a mesh
  double mm_per_unit = 1;
  reader.number("mm_per_unit", mm_per_unit, 1e-6, 1e6, "write how many mm one unit is");
  if ((file == nullptr) == (inline_mesh == nullptr)) {
    reader.faults().add(file ? reader.name("mesh") : reader.name("file"),
                        file ? "is given beside a file" : "is missing",
                        "name the FOLD or OBJ file with the mesh in \"file\"");
    return {};
  }
  if (file && !file->is_string()) {
    reader.faults().add(reader.shown("file"), "must be a text", "name a FOLD or OBJ file");
    return {};
  }
  if (file && !directory) {
    reader.faults().add(reader.shown("file"),
                        "a catalogue or an export holds its mesh, and no other file is opened",
                        "export it again, or put a backup in its place");
    return {};
  }
  const std::size_t before = reader.faults().count();
  const std::string name = file ? file->get<std::string>() : "";
  const Json document =
      file ? read_pattern_document((*directory / name).string(), FileKind::regular) : *inline_mesh;
  const std::string at = reader.name("mesh");
  const std::string place = file ? name : at == "mesh" ? "" : at;
  FoldMesh fold = read_fold(document, place,
                            reader.find("mm_per_unit") ? std::optional(mm_per_unit) : std::nullopt,
                            reader.faults());
  if (reader.faults().count() > before) return {};
  auto target = read_mesh_target(reader, document, directory, mm_per_unit, fold);
  return {{{"family", "fold"}},    place,
          std::move(fold.sheet),   std::move(fold.assignment),
          std::move(fold.missing), std::move(fold.reading),
          std::move(target)};
}

}  // namespace

FamilyMesh read_family(ObjectReader& reader,
                       const std::optional<std::filesystem::path>& directory) {
  const char* const kForms = "write \"miura\" or \"fold\"";
  std::string family = "miura";
  reader.require("family", kForms);
  reader.text("family", family, kForms);
  if (family == "miura") return read_miura(reader);
  if (family == "fold") return read_fold_mesh(reader, directory);
  reader.faults().add(reader.shown("family"), "is no pattern family", kForms);
  // Known keys, but not judged without a family.
  for (const char* key :
       {"rows", "columns", "panel_width_mm", "panel_height_mm", "zigzag_offset_mm", "file", "mesh",
        "mm_per_unit", "target_frame", "target_file"}) {
    reader.find(key);
  }
  return {};
}

}  // namespace misalign::schema
