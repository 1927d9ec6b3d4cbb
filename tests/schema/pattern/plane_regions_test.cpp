// FOLD files without faces: those that the edges enclose, and which of them are holes.
#include "schema/pattern/plane_regions.hpp"

#include <set>

#include "schema/pattern/carried_pattern.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "tests/schema/pattern/fold_meshes.hpp"

namespace misalign::schema {
namespace {

FoldMesh mesh_read_from(const Json& mesh) {
  InputFaults faults;
  FoldMesh read = read_fold(mesh, "", 1, faults);
  EXPECT_TRUE(faults.none()) << faults.sentences().front();
  return read;
}

std::vector<std::string> mesh_faults(const Json& mesh) {
  InputFaults faults;
  read_fold(mesh, "", 1, faults);
  return faults.sentences();
}

Json without_faces(Json mesh) {
  mesh.erase("faces_vertices");
  return mesh;
}

/// Places of facets and which of them are missing, whatever their order.
using Layout = std::set<std::pair<std::set<int>, bool>>;
Layout layout_of(const FoldMesh& mesh) {
  Layout layout;
  for (int f = 0; f < mesh.sheet.facet_count(); ++f) {
    const auto& corners = mesh.sheet.facets[f];
    layout.insert({std::set<int>(corners.begin(), corners.end()),
                   std::find(mesh.missing.begin(), mesh.missing.end(), f) != mesh.missing.end()});
  }
  return layout;
}

const char* const kMeshNames[] = {"double-corrugation-6x6", "angle-array-6x6", "turned-quads-6x6"};
std::string pattern_path(const std::string& name) {
  return MISALIGN_SOURCE_DIR "/search/patterns/" + name;
}

// Mountains and valleys everywhere inside: every region is a face.
TEST(FacesOfEdges, AreThoseThatTheFileHad) {
  for (const char* name : kMeshNames) {
    const Json mesh = read_json_file(pattern_path(name) + ".fold");
    EXPECT_EQ(layout_of(mesh_read_from(without_faces(mesh))), layout_of(mesh_read_from(mesh)))
        << name;
  }
  const Json miura = miura_mesh(6, 4);
  const FoldMesh read = mesh_read_from(without_faces(miura));
  EXPECT_EQ(layout_of(read), layout_of(mesh_read_from(miura)));
  EXPECT_EQ(read.sheet.places, mesh_read_from(miura).sheet.places) << "rows and columns";
  EXPECT_TRUE(read.missing.empty());
}

// What is exported has borders round its holes; a panel between four holes has borders only.
TEST(FacesOfEdges, HolesAreWhatBordersPartFromThem) {
  for (const std::string name : {"table1", "miura-graded-6x6", "angle-array-6x6"}) {
    const Pattern pattern = read_pattern_file(pattern_path(name) + ".json");
    Json mesh = perforated_mesh_json(pattern);
    mesh["vertices_coords"] = Json::array();
    const Eigen::Matrix2Xd vertices_mm = pattern.vertices_mm();
    for (Eigen::Index v = 0; v < vertices_mm.cols(); ++v) {
      mesh["vertices_coords"].push_back({vertices_mm(0, v), vertices_mm(1, v)});
    }
    const FoldMesh read = mesh_read_from(without_faces(mesh));
    EXPECT_EQ(layout_of(read), layout_of(mesh_read_from(mesh))) << name;
    EXPECT_EQ(read.missing.size(), pattern.base.holes.size()) << name;
  }
}

TEST(FacesOfEdges, AreRefusedWhereTheyDoNotFollow) {
  const auto expect_fault = [](const Json& mesh, const std::vector<std::string>& words) {
    const auto faults = mesh_faults(mesh);
    ASSERT_FALSE(faults.empty()) << words[0];
    for (const std::string& word : words) {
      EXPECT_NE(faults[0].find(word), std::string::npos) << word << " is not in: " << faults[0];
    }
  };
  const Json whole = without_faces(miura_mesh(4, 4));
  Json mesh = whole;  // one border within the sheet: no hole can be on one side of it
  mesh["edges_assignment"][edge_index(mesh, 6, 11)] = "B";
  EXPECT_EQ(mesh_faults(mesh).size(), 1u);
  expect_fault(mesh, {"edge A7-A12 is \"B\"", "faces_vertices is missing"});
  mesh = whole;  // a triangle and a pentagon
  mesh["edges_vertices"].push_back({6, 12});
  mesh["edges_assignment"].push_back("V");
  expect_fault(mesh, {"has 3 sides", "quadrilaterals"});
  mesh = whole;  // crossing edges enclose nothing that can be walked round
  mesh["edges_vertices"].push_back({6, 14});
  mesh["edges_assignment"].push_back("V");
  expect_fault(mesh, {"cross or touch"});
  mesh = whole;  // an edge that ends within a region
  mesh["vertices_coords"].push_back({140, 120});
  mesh["edges_vertices"].push_back({6, 25});
  mesh["edges_assignment"].push_back("V");
  expect_fault(mesh, {"has 6 sides"});
  mesh = whole;  // an edge is missing: two panels are one
  const std::size_t e = edge_index(mesh, 6, 11);
  mesh["edges_vertices"].erase(e);
  mesh["edges_assignment"].erase(e);
  expect_fault(mesh, {"has 6 sides"});
  mesh["edges_vertices"] = {{0, 1}};
  mesh["edges_assignment"] = {"B"};
  EXPECT_FALSE(mesh_faults(mesh).empty());
}

}  // namespace
}  // namespace misalign::schema
