// FOLD meshes as other programs write them: in any plane, from either side, in any unit, without
// letters, with cuts, in a frame.
#include <Eigen/Geometry>
#include <map>

#include "tests/schema/pattern/fold_faults.hpp"
#include "tests/solver/own_sheet.hpp"

namespace misalign::schema {
namespace {

Pattern pattern_read(const Json& pattern) {
  InputFaults faults;
  Pattern read = read_pattern(pattern, "", Displacements::allowed, ".", faults);
  EXPECT_TRUE(faults.none()) << faults.sentences().front();
  return read;
}

Json written(const Pattern& pattern) { return pattern_json(pattern, pattern.shifts_mm); }

/// The 4 x 4 Miura-ori, each vertex where `place` puts it.
template <class Place>
Json placed(const Place& place) {
  Json mesh = miura_mesh(4, 4);
  for (Json& p : mesh["vertices_coords"]) {
    const Eigen::Vector3d at = place(p[0].get<double>(), p[1].get<double>());
    p = {at.x(), at.y(), at.z()};
  }
  return mesh;
}

void turn_faces(Json& mesh) {
  for (Json& face : mesh["faces_vertices"]) std::reverse(face.begin(), face.end());
}

void exchange_letters(Json& mesh) {
  for (Json& letter : mesh["edges_assignment"]) {
    if (letter != "B") letter = letter == "M" ? "V" : "M";
  }
}

/// Turned out of the plane by a rotation and moved.
Json tilted() {
  const Eigen::Isometry3d turn = Eigen::Translation3d(30, -200, 70) *
                                 Eigen::AngleAxisd(0.7, Eigen::Vector3d(2, -1, 0.5).normalized());
  return placed([&](double x, double y) { return turn * Eigen::Vector3d(x, y, 0); });
}

// FOLD 1.2: "a valley crease points the two face normals into each other". Normals are by the
// corners of the file's own faces, on the folded shape; no letter of ours is asked.
void expect_letters_as_the_faces_say(const Json& mesh) {
  Json pattern = pattern_of(mesh);
  pattern["displacements_mm"] = {{"A7", {0.4, 0}}, {"A13", {0, -0.4}}, {"A18", {-0.4, 0.4}}};
  const Pattern read = pattern_read(pattern);
  const solver::OwnSheet own(read.base, read.shifts_mm, {.end_deg = 100});
  const std::size_t row = 60;
  ASSERT_GT(own.sheet.shapes_mm().size(), row);
  const Eigen::Matrix3Xd& shape = own.sheet.shapes_mm()[row];
  std::map<std::pair<int, int>, std::size_t> face_with;
  for (std::size_t f = 0; f < mesh["faces_vertices"].size(); ++f) {
    const std::vector<int> face = mesh["faces_vertices"][f];
    for (std::size_t k = 0; k < 4; ++k) face_with[{face[k], face[(k + 1) % 4]}] = f;
  }
  const auto middle = [&](std::size_t f) -> Eigen::Vector3d {
    const std::vector<int> face = mesh["faces_vertices"][f];
    return (shape.col(face[0]) + shape.col(face[1]) + shape.col(face[2]) + shape.col(face[3])) / 4;
  };
  int creases = 0;
  for (std::size_t e = 0; e < mesh["edges_vertices"].size(); ++e) {
    const int a = mesh["edges_vertices"][e][0], b = mesh["edges_vertices"][e][1];
    const auto left = face_with.find({a, b}), right = face_with.find({b, a});
    if (left == face_with.end() || right == face_with.end()) continue;
    const std::size_t f = left->second, g = right->second;
    const auto is_hole = [&](std::size_t face) {
      return std::ranges::binary_search(read.base.holes, static_cast<int>(face));
    };
    if (is_hole(f) || is_hole(g)) continue;
    const std::vector<int> face = mesh["faces_vertices"][f];
    const Eigen::Vector3d one = shape.col(face[1]) - shape.col(face[0]),
                          other = shape.col(face[2]) - shape.col(face[0]);
    const double towards_mm = one.cross(other).normalized().dot(middle(g) - middle(f));
    EXPECT_GT(std::abs(towards_mm), 1) << "folded by tens of degrees";
    EXPECT_EQ(towards_mm > 0, mesh["edges_assignment"][e] == "V") << solver::line_label(a, b);
    ++creases;
  }
  EXPECT_EQ(creases, 16);
}

TEST(FoldReading, LettersAreThoseOfTheSideFromWhichFacesRunCounterClockwise) {
  const Json upright = placed([](double x, double y) { return Eigen::Vector3d(x, 0, y); });
  for (const Json& mesh : {miura_mesh(4, 4), upright, tilted()}) {
    expect_letters_as_the_faces_say(mesh);
    Json below = mesh;
    turn_faces(below);
    expect_letters_as_the_faces_say(below);
  }
}

// The sheet across z keeps its coordinates, whichever way its faces run.
TEST(FoldReading, ClockwiseFacesAreTheSheetSeenFromBelow) {
  Json below = miura_mesh(4, 4);
  turn_faces(below);
  exchange_letters(below);
  const Pattern read = pattern_read(pattern_of(below));
  EXPECT_EQ(written(read), written(pattern_read(pattern_of(miura_mesh(4, 4)))));
  ASSERT_EQ(read.reading.size(), 1u);
  EXPECT_NE(read.reading[0].find("clockwise"), std::string::npos);
  EXPECT_TRUE(pattern_read(pattern_of(miura_mesh(4, 4))).reading.empty());
}

TEST(FoldReading, FacesThatRunBothWaysAreRefused) {
  for (const bool most : {false, true}) {
    Json mesh = miura_mesh(4, 4);
    if (most) turn_faces(mesh);
    for (const std::size_t f : {std::size_t{3}, std::size_t{10}}) {
      std::reverse(mesh["faces_vertices"][f].begin(), mesh["faces_vertices"][f].end());
    }
    expect_faults(
        pattern_of(mesh), 2,
        {"the face A", most ? "runs counter-clockwise" : "runs clockwise", "the same way round"});
  }
}

// Exactly the coordinates of the sheet across z, so that a campaign's identity is the same; each
// plane from the side from which the faces run counter-clockwise.
TEST(FoldReading, PlanesAcrossAnAxisGiveTheSameSheet) {
  const Json expected = written(pattern_read(pattern_of(miura_mesh(4, 4))));
  const auto expect_expected = [&](const Json& mesh, const std::string& said) {
    const Pattern read = pattern_read(pattern_of(mesh));
    EXPECT_EQ(written(read), expected) << said;
    ASSERT_EQ(read.reading.size(), said.empty() ? 0u : 1u);
    if (!said.empty()) {
      EXPECT_NE(read.reading[0].find(said), std::string::npos) << read.reading[0];
    }
  };
  using Eigen::Vector3d;
  expect_expected(placed([](double x, double y) { return Vector3d(x, y, 0); }), "");
  expect_expected(placed([](double x, double y) { return Vector3d(x, y, 12.5); }),
                  "the plane z = 12.5 mm");
  expect_expected(placed([](double x, double y) { return Vector3d(x, y, x > y ? 1e-15 : -1e-15); }),
                  "");
  expect_expected(placed([](double x, double y) { return Vector3d(x, 0, y); }),
                  "the plane y = 0 mm: x and y of the sheet are x and z of the file");
  expect_expected(placed([](double x, double y) { return Vector3d(y, -3, x); }),
                  "the plane y = -3 mm: x and y of the sheet are z and x of the file");
  expect_expected(placed([](double x, double y) { return Vector3d(7, x, y); }),
                  "the plane x = 7 mm: x and y of the sheet are y and z of the file");
  expect_expected(placed([](double x, double y) { return Vector3d(0, y, x); }),
                  "the plane x = 0 mm: x and y of the sheet are z and y of the file");
}

// Distances of all pairs of vertices, and areas, by which a mirrored sheet would be found.
TEST(FoldReading, ATiltedPlaneGivesACongruentSheet) {
  const Eigen::Matrix2Xd flat_mm = pattern_read(pattern_of(miura_mesh(4, 4))).vertices_mm();
  Json noisy = tilted();
  std::srand(5);
  for (Json& point : noisy["vertices_coords"]) {
    const Eigen::Vector3d off_mm = Eigen::Vector3d::Random() * 1e-9;
    for (int k = 0; k < 3; ++k) point[k] = point[k].get<double>() + off_mm[k];
  }
  for (const auto& [mesh, within_mm] : {std::pair(tilted(), 1e-11), std::pair(noisy, 1e-8)}) {
    const Pattern read = pattern_read(pattern_of(mesh));
    const Eigen::Matrix2Xd here_mm = read.vertices_mm();
    for (Eigen::Index i = 0; i < 25; ++i) {
      for (Eigen::Index k = 0; k < i; ++k) {
        EXPECT_NEAR((here_mm.col(i) - here_mm.col(k)).norm(),
                    (flat_mm.col(i) - flat_mm.col(k)).norm(), within_mm);
      }
    }
    EXPECT_EQ(read.base.folding.assignment(),
              pattern_read(pattern_of(miura_mesh(4, 4))).base.folding.assignment());
    ASSERT_FALSE(read.reading.empty());
    EXPECT_NE(read.reading[0].find("the plane"), std::string::npos);
  }
}

// The farthest that lies flat, and a little more: 2e-3 of an edge of 80 mm.
TEST(FoldReading, WhatIsNoPlaneIsRefused) {
  const auto raised = [](double z_mm) {
    Json mesh = miura_mesh(4, 4);
    mesh["vertices_coords"][12].push_back(z_mm);
    return pattern_of(mesh);
  };
  EXPECT_EQ(written(pattern_read(raised(0.15))), written(pattern_read(raised(0))));
  expect_faults(raised(0.3), 1,
                {"vertex A13 lies 0.", "off the plane of the others", "file_frames"});
}

TEST(FoldReading, TheEightUnitsOfTheStandard) {
  const Eigen::Matrix2Xd flat_mm = pattern_read(pattern_of(miura_mesh(4, 4))).vertices_mm();
  const std::vector<std::pair<std::string, double>> units = {
      {"unit", 1}, {"mm", 1},   {"in", 25.4}, {"pt", 25.4 / 72},
      {"cm", 10},  {"m", 1000}, {"um", 1e-3}, {"nm", 1e-6}};
  for (const auto& [unit, mm] : units) {
    Json mesh = miura_mesh(4, 4);
    mesh["frame_unit"] = unit;
    for (Json& p : mesh["vertices_coords"]) {
      p = {p[0].get<double>() / mm, p[1].get<double>() / mm};
    }
    EXPECT_LE((pattern_read(pattern_of(mesh)).vertices_mm() - flat_mm).norm(), 1e-10) << unit;
  }
}

TEST(FoldReading, ASheetOfOneUnitAsksForItsScale) {
  Json mesh = miura_mesh(4, 4);
  for (Json& p : mesh["vertices_coords"]) {
    p = {p[0].get<double>() / 320, p[1].get<double>() / 320};
  }
  for (const char* unit : {"", "unit"}) {
    mesh.erase("frame_unit");
    if (*unit) mesh["frame_unit"] = unit;
    expect_faults(pattern_of(mesh), 1,
                  {"the mesh is 1.125 by 1 units", "frame_unit", "mm_per_unit"});
    Json scaled = pattern_of(mesh);
    scaled["mm_per_unit"] = 320;
    EXPECT_EQ(pattern_read(scaled).base.sheet.panel_width_mm, 80);
    scaled["mm_per_unit"] = 1;  // said, however small
    EXPECT_EQ(pattern_read(scaled).base.sheet.panel_width_mm, 0.25);
  }
  mesh["frame_unit"] = "mm";
  EXPECT_EQ(pattern_read(pattern_of(mesh)).base.sheet.panel_width_mm, 0.25);
}

// Cuts and borders are the same round a hole.
TEST(FoldReading, CutsRoundHolesWithoutFaces) {
  Json mesh = read_json_file(MISALIGN_SOURCE_DIR "/search/patterns/double-corrugation-6x6.fold");
  mesh.erase("faces_vertices");
  const Json expected = written(pattern_read(pattern_of(mesh)));
  const auto perimeter = [&](const Json& ends) {
    const int a = ends[0], b = ends[1];
    const auto at_rim = [](int v) { return v < 7 || v >= 42 || v % 7 == 0 || v % 7 == 6; };
    return at_rim(a) && at_rim(b);
  };
  int cuts = 0;
  for (std::size_t e = 0; e < mesh["edges_vertices"].size(); ++e) {
    Json& letter = mesh["edges_assignment"][e];
    if (letter != "B" || perimeter(mesh["edges_vertices"][e])) continue;
    letter = "C";
    ++cuts;
  }
  EXPECT_EQ(cuts, 32) << "four round each of eight holes";
  EXPECT_EQ(written(pattern_read(pattern_of(mesh))), expected);
}

TEST(FoldReading, LettersThatAreLeftOpenFollowFromTheOthers) {
  const Json whole = miura_mesh(4, 4);
  const Json expected = written(pattern_read(pattern_of(whole)));
  Json none = whole, absent = whole, one = whole, mountain = whole;
  for (Json& letter : none["edges_assignment"]) {
    if (letter != "B") letter = "U";
  }
  absent.erase("edges_assignment");
  one["edges_assignment"][edge_index(one, 1, 6)] = "U";  // the pilot
  for (const Json& mesh : {none, absent, one}) {
    const Pattern read = pattern_read(pattern_of(mesh));
    EXPECT_EQ(written(read), expected);
    ASSERT_EQ(read.reading.size(), 1u);
    EXPECT_NE(read.reading[0].find(mesh == one ? "unassigned creases: 1" : "the pilot A2-A7"),
              std::string::npos)
        << read.reading[0];
  }
  // A pilot that the others make a mountain.
  exchange_letters(mountain);
  const Json from_below = written(pattern_read(pattern_of(mountain)));
  mountain["edges_assignment"][edge_index(mountain, 1, 6)] = "U";
  EXPECT_EQ(written(pattern_read(pattern_of(mountain))), from_below);
  // Every vertex can fold in two ways.
  Json open = read_json_file(MISALIGN_SOURCE_DIR "/search/patterns/angle-array-6x6.fold");
  open.erase("edges_assignment");
  expect_faults(pattern_of(open), 1, {"can fold in two ways", "edges_assignment"});
}

TEST(FoldReading, TheCreasePatternMayBeAFrame) {
  const Json mesh = miura_mesh(4, 4);
  const Json expected = written(pattern_read(pattern_of(mesh)));
  const auto expect_frame = [&](const Json& file, const char* said) {
    const Pattern read = pattern_read(pattern_of(file));
    EXPECT_EQ(written(read), expected);
    ASSERT_EQ(read.reading.size(), *said ? 1u : 0u);
    if (*said) {
      EXPECT_NE(read.reading[0].find(said), std::string::npos) << read.reading[0];
    }
  };
  const auto of_class = [](Json frame, const char* name) {
    frame["frame_classes"] = {name};
    return frame;
  };
  const Json folded = of_class(
      placed([](double x, double y) { return Eigen::Vector3d(x, y, x * y / 100); }), "foldedForm");
  const Json metadata = {{"file_spec", 1.2}, {"file_title", "frames only"}};
  const auto with_frames = [](Json file, const Json& frames) {
    file["file_frames"] = frames;
    return file;
  };
  const char* const second = "frame 2 of file_frames";
  expect_frame(with_frames(metadata, {folded, mesh}), second);
  expect_frame(with_frames(metadata, {folded, of_class(mesh, "creasePattern")}), second);
  expect_frame(with_frames(folded, {folded, of_class(mesh, "creasePattern")}), second);
  expect_frame(with_frames(mesh, {folded, of_class(mesh, "creasePattern")}), "");
  // Coordinates of its own, all else inherited over two frames.
  Json parent = metadata;
  for (const auto& [key, value] : mesh.items()) {
    if (key != "vertices_coords") parent[key] = value;
  }
  const Json between = {{"frame_inherit", true}, {"frame_parent", 0}};
  Json child = {{"frame_inherit", true},
                {"frame_parent", 1},
                {"frame_classes", {"creasePattern"}},
                {"vertices_coords", mesh["vertices_coords"]}};
  expect_frame(with_frames(parent, {between, child}), second);
  child["frame_parent"] = 2;  // its own parent
  expect_faults(pattern_of(with_frames(parent, {between, child})), 1,
                {"edges_vertices", "missing"});
  expect_faults(pattern_of(with_frames(metadata, {1, between})), 1, {"vertices_coords", "missing"});
  // A file by itself speaks of frames, not of pattern files.
  try {
    read_sampled_pattern(metadata, "x.fold", ".");
    ADD_FAILURE() << "read";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("vertices_coords (is missing)"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace misalign::schema
