// Surfaces of files: the same mesh in all formats, a sentence for each fault, and any bytes.
#include "schema/surface/surface_file.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "solver/target/mesh_surface.hpp"
#include "tests/folder.hpp"
#include "tests/schema/surface/written_surface.hpp"

namespace misalign::schema {
namespace {

using Form = WrittenSurface::Form;

std::string faults_of(const std::string& bytes, const std::string& name = "hull.obj") {
  InputFaults faults;
  const auto mesh = read_surface_mesh(bytes, name, faults);
  EXPECT_EQ(mesh.has_value(), faults.none());
  std::string all;
  for (const std::string& sentence : faults.sentences()) all += sentence + "\n";
  return all;
}

void expect_fault(const WrittenSurface& surface, const std::string& sentence) {
  EXPECT_NE(faults_of(surface.obj()).find(sentence), std::string::npos)
      << "expected: " << sentence << "\nfound: " << faults_of(surface.obj());
}

// The mesh of a file, or UserError with every fault.
TriangleMesh mesh_of_file(const std::string& path) {
  InputFaults faults;
  auto mesh = read_surface_mesh(read_input_file(path), path, faults);
  faults.refuse(path);
  return std::move(*mesh);
}

WrittenSurface flat(int cells = 8) {
  return WrittenSurface::square(cells, [](double, double) { return 0; });
}

TEST(SurfaceFile, IsTheSameSurfaceInAllFormats) {
  const Folder folder("surface_file");
  const WrittenSurface bowl = WrittenSurface::bowl(16);
  const std::string files[] = {folder.file("a.obj", bowl.obj()),
                               folder.file("a.stl", bowl.stl_text()),
                               folder.file("b.stl", bowl.stl_bytes()),
                               folder.file("without-an-ending", bowl.stl_bytes()),
                               folder.file("a.ply", bowl.ply(Form::text)),
                               folder.file("b.ply", bowl.ply(Form::little)),
                               folder.file("c.ply", bowl.ply(Form::big))};
  for (const std::string& file : files) {
    const TriangleMesh mesh = mesh_of_file(file);
    EXPECT_EQ(mesh.vertices_mm.cols(), 17 * 17) << file;
    EXPECT_EQ(mesh.triangles.cols(), 2 * 16 * 16) << file;
    const auto surface = solver::mesh_surface(mesh.vertices_mm, mesh.triangles);
    // Heights are written in 64ths of a millimetre, and quadrics fitted to them.
    for (const double x : {-60.0, 3.0, 71.0}) {
      const Eigen::Vector3d above(x, x / 2, 1.25 * x * x / 1024);
      EXPECT_NEAR(surface->distance(above).mm, 0, 1.0 / 64) << file;
    }
  }
}

TEST(SurfaceFile, SplitsPolygonsAndLeavesOutWhatHasNoArea) {
  WrittenSurface surface;
  for (int k = 0; k < 6; ++k) {
    surface.points.emplace_back(50 * std::cos(k * std::numbers::pi / 3),
                                50 * std::sin(k * std::numbers::pi / 3), 0);
  }
  surface.points.emplace_back(7, 7, 7);  // of no face
  surface.faces = {{0, 1, 2, 3, 4, 5}, {0, 1, 0}};
  InputFaults faults;
  const auto mesh = read_surface_mesh(surface.obj(), "", faults);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->triangles.cols(), 4);
  EXPECT_EQ(mesh->vertices_mm.cols(), 6);
}

TEST(SurfaceFile, TakesTrianglesOfAnyTurnAndSlivers) {
  WrittenSurface surface = WrittenSurface::bowl();
  std::ranges::reverse(surface.faces[10]);
  std::ranges::reverse(surface.faces[11]);
  EXPECT_EQ(faults_of(surface.obj()), "");
  // A vertex on an edge, with a triangle without height that closes the gap.
  WrittenSurface sliver = flat(1);
  sliver.points.emplace_back(0, 0, 0);
  sliver.faces = {{0, 1, 3}, {0, 4, 2}, {4, 3, 2}, {0, 3, 4}};
  EXPECT_EQ(faults_of(sliver.obj()), "");
}

TEST(SurfaceFile, NamesFilesThatAreNone) {
  const Folder folder("surface_file");
  try {
    mesh_of_file(folder.file("missing.obj"));
    ADD_FAILURE();
  } catch (const UserError& error) {
    EXPECT_EQ(error.cause(), Cause::bad_input);
    EXPECT_NE(std::string(error.what()).find("missing.obj: cannot be opened"), std::string::npos);
  }
  try {
    mesh_of_file(folder.file("empty.obj", ""));
    ADD_FAILURE();
  } catch (const UserError& error) {
    EXPECT_EQ(error.what(), folder.file("empty.obj") +
                                ": the file (is no OBJ, STL or PLY); export the surface as one of "
                                "these");
  }
}

TEST(SurfaceFile, NamesFaultsOfObj) {
  EXPECT_EQ(faults_of("hello\n"),
            "the file (is no OBJ, STL or PLY); export the surface as one of these\n");
  const std::string text = "v 0 0 0\nv 1 x 0\nv 1 nan 0\nv 1 2\nf 1 2 b\nf 1 2.5 3\n";
  EXPECT_EQ(faults_of(text),
            "vertex 2 and 2 others (needs three finite numbers); write the file again from the "
            "program it comes from\n"
            "face 1 and 1 other (has a corner that is no whole number); write corners like 7 or "
            "7/1/3\n");
  EXPECT_EQ(faults_of("v 0 0 0\nv 1 0 0\nf 1 2\nf 1 2 3\nf -3 1 2\n"),
            "face 2 and 1 other (has a corner that is none of 2 vertices); write the file again "
            "from the program it comes from\n"
            "face 1 (has fewer than three corners); remove it\n");
  EXPECT_EQ(faults_of("v 0 0 0\nv 1 0 0\nv 1 0 0\nf 1 2 3\n"),
            "the mesh (has no triangles); export the surface with its faces\n");
}

TEST(SurfaceFile, NamesFaultsOfStl) {
  EXPECT_EQ(faults_of("short", "a.stl"),
            "binary STL (is shorter than its header: 5 bytes); write the file again: it is not "
            "whole\n");
  const std::string bytes = flat(1).stl_bytes();
  EXPECT_EQ(faults_of("x" + bytes.substr(1, 150), "A.STL"),
            "binary STL (says 2 facets, which are 184 bytes, but has 151); write the file again: "
            "it is not whole\n");
  std::string infinite = bytes;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(infinite.data() + 84 + 12, &nan, sizeof(nan));
  EXPECT_EQ(faults_of(infinite),
            "vertex 1 (needs three finite numbers); write the file again from the program it comes "
            "from\n");
  const std::string text = flat(1).stl_text();
  EXPECT_EQ(faults_of(text.substr(0, text.find("endsolid"))),
            "STL (has no endsolid); write the file again: it is not whole\n");
  EXPECT_EQ(faults_of("solid\nvertex 0 0 0\nvertex 0 1\nendsolid\n"),
            "a vertex of facet 1 (needs three finite numbers); write the file again from the "
            "program it comes from\n"
            "STL (has a facet without three vertices); write the file again: it is not whole\n");
}

TEST(SurfaceFile, NamesFaultsOfPly) {
  const std::string whole = flat(1).ply(Form::text),
                    again = "; write the file again from the program it comes from\n";
  const auto with = [&](const std::string& what, const std::string& instead) {
    std::string text = whole;
    return faults_of(text.replace(text.find(what), what.size(), instead));
  };
  EXPECT_EQ(with("end_header\n", ""), "PLY (has no end_header)" + again);
  EXPECT_EQ(with("ascii", "utf8"), "PLY (has no format that is known)" + again);
  EXPECT_EQ(with("property double x", "property long x"),
            "PLY's line \"property long x\" (is not understood)" + again);
  EXPECT_EQ(with("element vertex 4", "element vertex four"),
            "PLY's line \"element vertex four\" (is not understood)" + again);
  EXPECT_EQ(with("double z", "double w"), "vertex 0 (has no x, y and z)" + again);
  EXPECT_EQ(with("200", "two"), "vertex 0 (needs finite numbers)" + again);
  EXPECT_EQ(with("4 0 1 3 2", "-4 0 1 3 2"), "face 0 (is not whole)" + again);
  for (const Form form : {Form::text, Form::little, Form::big}) {
    const std::string bytes = flat(1).ply(form);
    EXPECT_EQ(faults_of(bytes.substr(0, bytes.size() - 8)), "face 0 (is not whole)" + again);
  }
}

TEST(SurfaceFile, NamesFaultsOfItsSize) {
  WrittenSurface metres = WrittenSurface::bowl();
  for (auto& p : metres.points) p /= 1000;
  const std::string why =
      " (x and y must be at least 5, all at most 100000); scale it to millimetres, and turn it so "
      "that z is up";
  expect_fault(metres, "the mesh is 0.2 mm wide in x, 0.2 in y and 0.01953 in z" + why);
  for (auto& p : metres.points) p *= 1e6;
  expect_fault(metres, "the mesh is 2e+05 mm wide in x, 2e+05 in y and 1.953e+04 in z" + why);
  WrittenSurface spike = flat();
  spike.points[40].z() = 1e20;
  expect_fault(spike, "the mesh is 200 mm wide in x, 200 in y and 1e+20 in z" + why);
}

TEST(SurfaceFile, NamesEdgesWithThreeTriangles) {
  WrittenSurface fin = flat();
  fin.points.emplace_back(0, 0, 50);
  fin.faces.push_back({40, 41, 81});
  expect_fault(fin,
               "the edge from (0, 0, 0) to (25, 0, 0) (belongs to more than two triangles); keep "
               "one side of each: the surface is a single layer");
}

TEST(SurfaceFile, NamesParts) {
  WrittenSurface parts = flat(2), other = flat(2);
  for (auto& face : other.faces) {
    for (int& v : face) v += 9;
  }
  for (auto& p : other.points) parts.points.emplace_back(p.x() + 300, p.y(), 1);
  parts.faces.insert(parts.faces.end(), other.faces.begin(), other.faces.end());
  expect_fault(parts, "the mesh has 2 parts without a common edge, one of them at (");
  // Corners that touch are no common edge.
  WrittenSurface corners = flat(2);
  corners.faces = {corners.faces[0], corners.faces[3]};
  expect_fault(corners, "the mesh has 2 parts without a common edge, one of them at (");
}

TEST(SurfaceFile, NamesHolesAndClosedMeshes) {
  WrittenSurface holes = flat();
  holes.faces.erase(holes.faces.begin() + 27);
  holes.faces.erase(holes.faces.begin() + 9);
  expect_fault(holes, "and 1 other (leaves vertices of a sheet without a place); fill it\n");
  expect_fault(holes, "the hole at (-62.5, -62.5, 0), 35.4 mm wide,");
  WrittenSurface closed = flat(1);
  closed.points.emplace_back(0, 0, 30);
  closed.faces = {{0, 1, 3, 2}, {0, 1, 4}, {1, 3, 4}, {3, 2, 4}, {2, 0, 4}};
  expect_fault(closed,
               "the mesh (is closed, like the skin of a body); keep the side on which the sheet "
               "shall lie");
  expect_fault(closed, "folds back under itself");
}

TEST(SurfaceFile, NamesWallsAndOverhangs) {
  const WrittenSurface wall = WrittenSurface::square(
      8, [](double x, double) { return x > 0 ? 25 / std::tan(4 * std::numbers::pi / 180) : 0; });
  expect_fault(wall, "and 15 others (is as steep as 85 deg); turn the mesh so that z is up");
  const WrittenSurface slope = WrittenSurface::square(
      8, [](double x, double) { return x > 0 ? 25 / std::tan(6 * std::numbers::pi / 180) : 0; });
  EXPECT_EQ(faults_of(slope.obj()), "");
  WrittenSurface wave = flat();
  for (auto& p : wave.points) p = {60 * std::sin(p.x() / 25), p.y(), p.x()};
  expect_fault(wave, "folds back under itself");
}

TEST(SurfaceFile, NamesPlacesWithTwoHeights) {
  WrittenSurface stair = WrittenSurface::square(24, [](double, double) { return 0; });
  for (auto& p : stair.points) {
    const double turn = p.x() / 25, out = 150 + p.y();
    p = {out * std::cos(turn), out * std::sin(turn), 20 * turn};
  }
  expect_fault(stair, "(has two heights); remove what lies under or over the surface");
}

// Any change of a file, and any part of it, is a mesh or a sentence.
TEST(SurfaceFile, TakesAnyBytes) {
  std::mt19937 random(1);
  const WrittenSurface bowl = WrittenSurface::bowl(3);
  const std::pair<std::string, const char*> files[] = {
      {bowl.obj(), "a.obj"},       {bowl.stl_text(), "a.stl"},   {bowl.stl_bytes(), "b.stl"},
      {bowl.ply(Form::text), "a"}, {bowl.ply(Form::little), ""}, {bowl.ply(Form::big), ""}};
  const auto below = [&](std::size_t most) { return random() % std::max<std::size_t>(1, most); };
  int meshes = 0, refused = 0;
  for (const auto& [whole, name] : files) {
    for (int k = 0; k < 1500; ++k) {
      std::string bytes = whole;
      for (std::size_t changes = below(4); changes-- > 0 && !bytes.empty();) {
        switch (const std::size_t at = below(bytes.size()); below(4)) {
          case 0:
            bytes.resize(at);
            break;
          case 1:
            bytes[at] = static_cast<char>(random());
            break;
          case 2:
            bytes.insert(at, bytes.substr(below(bytes.size()), below(40)));
            break;
          default:
            bytes.erase(at, below(40));
        }
      }
      InputFaults faults;
      const auto mesh = read_surface_mesh(bytes, name, faults);
      EXPECT_EQ(mesh.has_value(), faults.none());
      (mesh ? meshes : refused) += 1;
      if (!mesh) continue;
      EXPECT_LT(mesh->triangles.maxCoeff(), mesh->vertices_mm.cols());
    }
  }
  EXPECT_GT(meshes, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace misalign::schema
