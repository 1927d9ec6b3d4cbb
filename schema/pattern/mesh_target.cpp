#include "schema/pattern/mesh_target.hpp"

#include <algorithm>
#include <set>

#include "schema/files/json_values.hpp"
#include "schema/pattern/fold_frames.hpp"
#include "schema/pattern/fold_units.hpp"
#include "schema/pattern/pattern_document.hpp"
#include "schema/pattern/plane_mesh.hpp"
#include "schema/pattern/sheet_places.hpp"

namespace misalign::schema {
namespace {

// A frame with the target's coordinates, and its name.
struct TargetFrame {
  Json frame;
  std::string name;
};

std::string frame_name(const FoldFrame& frame) {
  return frame.number == 0 ? "the key frame"
                           : "frame " + std::to_string(frame.number) + " of file_frames";
}

std::optional<TargetFrame> find_numbered(ObjectReader& reader, const Json& document,
                                         const Json& number) {
  for (FoldFrame& frame : folded_form_frames(document)) {
    if (number == frame.number) return TargetFrame{std::move(frame.frame), frame_name(frame)};
  }
  reader.faults().add(reader.shown("target_frame"),
                      "no folded form with coordinates has this number",
                      "write the number of a frame of class foldedForm, 1 for the first of "
                      "file_frames");
  return std::nullopt;
}

std::optional<TargetFrame> find_file(ObjectReader& reader,
                                     const std::optional<std::filesystem::path>& directory,
                                     const Json& file) {
  if (!file.is_string()) {
    reader.faults().add(reader.shown("target_file"), "must be a text", "name a FOLD or OBJ file");
    return std::nullopt;
  }
  if (!directory) {
    reader.faults().add(reader.shown("target_file"),
                        "a catalogue or an export holds its mesh, and no other file is opened",
                        "export it again, or put a backup in its place");
    return std::nullopt;
  }
  const auto name = file.get<std::string>();
  Json document = read_pattern_document((*directory / name).string(), FileKind::regular);
  auto folded = folded_form_frames(document);
  return TargetFrame{folded.size() == 1 ? std::move(folded.front().frame) : std::move(document),
                     name};
}

// The coordinates, with faults that name vertices.
solver::FoldedVertices read_places(const TargetFrame& target, double mm_per_unit, int count,
                                   MeshFaults& faults) {
  const Json coordinates = target.frame.is_object()
                               ? target.frame.value("vertices_coords", Json::array())
                               : Json::array();
  if (static_cast<int>(coordinates.size()) != count) {
    faults.add("the target has " + std::to_string(coordinates.size()) + " vertices",
               "the flat mesh has " + std::to_string(count),
               "give the same vertices, flat and folded, in the same order");
    return {};
  }
  const double unit_mm = mm_of_unit(target.frame.value("frame_unit", Json("unit"))).value_or(1);
  solver::FoldedVertices places_mm = solver::FoldedVertices::Zero(3, count);
  for (int v = 0; v < count; ++v) {
    const Json& point = coordinates[static_cast<std::size_t>(v)];
    if (!are_numbers(point, 3)) {
      faults.add("vertex " + solver::vertex_label(v) + " = " + point.dump().substr(0, 40),
                 "must be three numbers at the target", "write [x, y, z]");
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      places_mm(static_cast<Eigen::Index>(k), v) = unit_mm * mm_per_unit * point[k].get<double>();
    }
  }
  return places_mm;
}

// CornerSet of a face in ascending order.
using CornerSet = std::multiset<int>;

void compare_faces(const Json& frame, const FoldMesh& mesh, MeshFaults& faults) {
  const auto listed = frame.find("faces_vertices");
  if (listed == frame.end() || !listed->is_array()) return;
  std::set<CornerSet> flat, folded;
  const std::size_t faces = mesh.sheet.facets.size() - mesh.missing.size();
  for (std::size_t f = 0; f < faces; ++f) {
    flat.insert(CornerSet(mesh.sheet.facets[f].begin(), mesh.sheet.facets[f].end()));
  }
  for (const Json& face : *listed) {
    CornerSet corners;
    for (const Json& v : face) {
      if (v.is_number_integer()) corners.insert(v.get<int>());
    }
    if (!flat.contains(corners)) {
      faults.add("the target's face " + face.dump().substr(0, 60), "the flat mesh has no such face",
                 "give the same faces, flat and folded");
    }
    folded.insert(std::move(corners));
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const auto& corners = mesh.sheet.facets[f];
    if (!folded.contains(CornerSet(corners.begin(), corners.end()))) {
      faults.add(face_label(corners), "the target has no such face",
                 "give the same faces, flat and folded");
    }
  }
}

}  // namespace

std::optional<MeshTarget> read_mesh_target(ObjectReader& reader, const Json& document,
                                           const std::optional<std::filesystem::path>& directory,
                                           double mm_per_unit, const FoldMesh& mesh) {
  const Json *const number = reader.find("target_frame"), *const file = reader.find("target_file");
  const bool is_named = number || file;
  if (number && file) {
    reader.faults().add(reader.name("target_frame"), "is given beside a target_file",
                        "leave one of them out");
    return std::nullopt;
  }
  std::optional<TargetFrame> frame;
  if (number) {
    frame = find_numbered(reader, document, *number);
  } else if (file) {
    frame = find_file(reader, directory, *file);
  } else if (auto folded = folded_form_frames(document); folded.size() == 1) {
    frame = TargetFrame{std::move(folded.front().frame), frame_name(folded.front())};
  }
  if (!frame) return std::nullopt;
  InputFaults passed_over;  // of a frame that no key names
  InputFaults& faults = is_named ? reader.faults() : passed_over;
  const std::size_t before = faults.count();
  MeshFaults of_target(frame->name, faults);
  MeshTarget target{frame->name, is_named,
                    read_places(*frame, mm_per_unit, mesh.sheet.vertex_count(), of_target)};
  if (faults.count() == before) {
    of_target.next_kind();
    compare_faces(frame->frame, mesh, of_target);
  }
  return faults.count() == before ? std::optional(std::move(target)) : std::nullopt;
}

void add_folded_form(const Eigen::Matrix3Xd& vertices_mm, Json& fold) {
  Json vertices = Json::array();
  for (const auto& at : vertices_mm.colwise()) vertices.push_back({at.x(), at.y(), at.z()});
  fold["file_frames"] = {{{"frame_classes", {"foldedForm"}},
                          {"frame_parent", 0},
                          {"frame_inherit", true},
                          {"vertices_coords", vertices}}};
}

}  // namespace misalign::schema
