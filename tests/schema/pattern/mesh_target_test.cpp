// Meshes with a folded target: a frame of FOLD, a second file, what is closed and what is refused.
#include <Eigen/Geometry>
#include <fstream>

#include "schema/campaign/campaign_file.hpp"
#include "solver/linear/mobility.hpp"
#include "tests/schema/pattern/fold_faults.hpp"
#include "tests/solver/designed_mesh.hpp"
#include "tests/solver/own_sheet.hpp"

namespace misalign::schema {
namespace {

using solver::DesignedMesh;

Json points_json(const Eigen::MatrixXd& points) {
  Json list = Json::array();
  for (const auto& point : points.colwise())
    list.push_back(std::vector<double>(point.begin(), point.end()));
  return list;
}

/// FOLD without letters, the target as its only frame.
Json fold_of(const DesignedMesh& mesh) {
  Json edges = Json::array(), letters = Json::array();
  for (const solver::Edge& edge : mesh.flat.edges) {
    edges.push_back({edge.a, edge.b});
    letters.push_back(edge.on_perimeter() ? "B" : "U");
  }
  return {{"file_spec", 1.2},
          {"vertices_coords", points_json(mesh.flat.vertices_mm)},
          {"edges_vertices", edges},
          {"edges_assignment", letters},
          {"faces_vertices", mesh.flat.facets},
          {"file_frames",
           {{{"frame_classes", {"foldedForm"}},
             {"frame_parent", 0},
             {"frame_inherit", true},
             {"vertices_coords", points_json(mesh.folded_mm)}}}}};
}

std::string obj_of(const DesignedMesh& mesh, const Eigen::MatrixXd& points) {
  std::string text;
  for (const auto& point : points.colwise()) {
    text += "v";
    for (Eigen::Index k = 0; k < 3; ++k)
      text += " " + Json(k < point.size() ? point(k) : 0.0).dump();
    text += "\n";
  }
  for (const auto& f : mesh.flat.facets) {
    text += "f";
    for (const int v : f) text += " " + std::to_string(v + 1);
    text += "\n";
  }
  return text;
}

std::string written(const std::string& name, const std::string& text) {
  std::ofstream(testing::TempDir() + name) << text;
  return name;
}

/// Largest distance of the sheet's vertices at the target from the file's.
double off_mm(const Pattern& pattern, const solver::FoldedVertices& folded_mm) {
  const solver::OwnSheet own(pattern.base, pattern.shifts_mm,
                             {.end_deg = pattern.base.folding.end_deg()});
  const Eigen::Matrix3Xd& found = own.sheet.at(pattern.folded_target->pilot_deg).vertices_mm;
  const Eigen::Isometry3d onto(Eigen::umeyama(found, folded_mm, false));
  return (onto * found - folded_mm).colwise().norm().maxCoeff();
}

struct TargetMesh : testing::Test {
  const DesignedMesh curved = solver::curved_mesh(6, 6, {6e-4, -4e-4}, 0.5, 7);
  const DesignedMesh miura = solver::graded_miura(6, 6, 0.7);
};

TEST_F(TargetMesh, AFrameIsTheTarget) {
  const Pattern read = good(pattern_of(fold_of(curved)));
  ASSERT_TRUE(read.folded_target);
  EXPECT_TRUE(read.base.folding.path());
  EXPECT_LT(off_mm(read, curved.folded_mm), 1e-9);
  EXPECT_EQ(read.base.sheet.vertices_mm, curved.flat.vertices_mm);
  ASSERT_EQ(read.reading.size(), 2U);
  EXPECT_NE(read.reading[0].find("frame 1 of file_frames is the target"), std::string::npos);
  EXPECT_NE(read.reading[1].find("one degree of freedom"), std::string::npos);
  // A catalogue stores it like this.
  const Json stored = pattern_json(read, read.shifts_mm);
  const Pattern again = good(parse_json(stored.dump(), "stored"));
  EXPECT_EQ(pattern_json(again, again.shifts_mm), stored);
  EXPECT_EQ(again.folded_target->pilot_deg, read.folded_target->pilot_deg);
}

// Seen from below, and on its side, the target is the same state.
TEST_F(TargetMesh, IsReadInAnyOrientation) {
  const Pattern read = good(pattern_of(fold_of(curved)));
  Json turned = fold_of(curved);
  for (Json& face : turned["faces_vertices"]) std::reverse(face.begin(), face.end());
  EXPECT_LT(off_mm(good(pattern_of(turned)), curved.folded_mm), 1e-9);
  for (Json& point : turned["vertices_coords"]) point = {point[0], 0.0, point[1]};
  const Pattern upright = good(pattern_of(turned));
  EXPECT_LT(off_mm(upright, curved.folded_mm), 1e-9);
  EXPECT_NEAR(upright.folded_target->pilot_deg, read.folded_target->pilot_deg, 1e-9);
}

TEST_F(TargetMesh, APairOfObjFilesIsRead) {
  const Json pattern = {{"family", "fold"},
                        {"file", written("flat.obj", obj_of(curved, curved.flat.vertices_mm))},
                        {"target_file", written("folded.obj", obj_of(curved, curved.folded_mm))},
                        {"holes", "checkerboard-even"}};
  InputFaults faults;
  const Pattern read =
      read_pattern(pattern, "", Displacements::allowed, testing::TempDir(), faults);
  ASSERT_TRUE(faults.none()) << faults.sentences().front();
  EXPECT_LT(off_mm(read, curved.folded_mm), 1e-9);
  InputFaults stored;
  read_pattern(pattern, "", Displacements::allowed, {}, stored);
  EXPECT_FALSE(stored.none());
}

TEST_F(TargetMesh, ARigidMeshKeepsItsClosedForm) {
  const Pattern read = good(pattern_of(fold_of(miura)));
  ASSERT_TRUE(read.folded_target);
  EXPECT_FALSE(read.base.folding.path());
  EXPECT_EQ(read.base.folding.end_deg(), 180);
  EXPECT_LT(off_mm(read, miura.folded_mm), 1e-9);
  EXPECT_NE(read.reading[1].find("folds rigidly"), std::string::npos);
}

// Gaps as coordinates of 0.001 mm leave them.
TEST_F(TargetMesh, SmallGapsAreClosed) {
  DesignedMesh rounded = curved;
  const auto round = [](auto& places) { places = (places * 1e3).array().round() / 1e3; };
  round(rounded.flat.vertices_mm);
  round(rounded.folded_mm);
  const Pattern read = good(pattern_of(fold_of(rounded)));
  ASSERT_EQ(read.reading.size(), 3U);
  EXPECT_NE(read.reading[0].find("the nearest sheet moves vertices by at most 0.00"),
            std::string::npos)
      << read.reading[0];
  // Half a last place in three coordinates, and as much for what the constraints add.
  EXPECT_LT(off_mm(read, rounded.folded_mm), 2e-3);
  EXPECT_LT(off_mm(read, read.folded_target->vertices_mm), 1e-7);
  const Json stored = pattern_json(read, read.shifts_mm);
  const Pattern again = good(stored);
  EXPECT_EQ(again.reading.size(), 2U);
  EXPECT_EQ(pattern_json(again, again.shifts_mm), stored);
}

TEST_F(TargetMesh, SpringsAreRelaxedAtTheTarget) {
  const Json mesh = fold_of(curved);
  const PatternFile alone = read_sampled_pattern(mesh, "x", ".");
  EXPECT_EQ(alone.design.rest_deg, alone.pattern.folded_target->pilot_deg);
  Json pattern = pattern_of(mesh);
  pattern["design"] = {{"springs", {{"rest_deg", 12}}}};
  EXPECT_EQ(read_sampled_pattern(pattern, "x", ".").design.rest_deg, 12);
  pattern["design"] = {{"fill", {{"kind", "none"}}}};
  EXPECT_FALSE(read_sampled_pattern(pattern, "x", ".").design.rest_deg);
}

TEST_F(TargetMesh, FaultsAreSentences) {
  const auto with_target = [](Json fold) {
    Json pattern = pattern_of(std::move(fold));
    pattern["target_frame"] = 1;
    return pattern;
  };
  const Json fold = fold_of(curved);
  Json bad = fold;
  Json& points = bad["file_frames"][0]["vertices_coords"];
  points.push_back({0, 0, 0});
  expect_faults(with_target(bad), 1, {"the target has 50 vertices", "has 49"});
  bad = fold;
  bad["file_frames"][0]["vertices_coords"][3] = {1, 2};
  bad["file_frames"][0]["vertices_coords"][5] = {1, 2, "x"};
  expect_faults(with_target(bad), 2, {"vertex A", "three numbers"});
  bad = fold;
  bad["file_frames"][0]["faces_vertices"] = bad["faces_vertices"];
  bad["file_frames"][0]["faces_vertices"][0] = {0, 1, 2, 7};
  expect_faults(with_target(bad), 2, {"face", "no such face"});
  // A corner moved by 2 mm within its panel, and a panel that is off its plane.
  bad = fold;
  const Eigen::Vector3d off = curved.folded_mm.col(0) +
                              2 * (curved.folded_mm.col(1) - curved.folded_mm.col(0)).normalized();
  bad["file_frames"][0]["vertices_coords"][0] = {off.x(), off.y(), off.z()};
  expect_faults(with_target(bad), 1, {"A1-", "mm long, flat", "rigid"});
  bad = fold;
  const Eigen::Vector3d normal =
      Eigen::Vector3d(curved.folded_mm.col(1) - curved.folded_mm.col(0))
          .cross(Eigen::Vector3d(curved.folded_mm.col(7) - curved.folded_mm.col(0)))
          .normalized();
  const Eigen::Vector3d lifted = curved.folded_mm.col(0) + normal;
  bad["file_frames"][0]["vertices_coords"][0] = {lifted.x(), lifted.y(), lifted.z()};
  expect_faults(with_target(bad), 1, {"the panel [0,0]", "off a plane"});
  Json pattern = pattern_of(fold);
  pattern["target_frame"] = 2;
  expect_faults(pattern, 1, {"target_frame = 2", "no folded form"});
  pattern["target_file"] = "x.obj";
  expect_faults(pattern, 1, {"target_frame", "beside a target_file"});
  pattern.erase("target_frame");
  pattern["target_file"] = 3;
  expect_faults(pattern, 1, {"target_file = 3", "must be a text"});
  pattern = pattern_of(fold);
  pattern["holes"] = {{1, 2}, {3, 3}};
  expect_faults(pattern, 1, {"degrees of freedom", "take out 8"});
}

// A frame that no key names is no target if it is another shape, or if there are several.
TEST_F(TargetMesh, DrawingsArePassedOver) {
  Json drawing = fold_of(miura);
  for (Json& point : drawing["file_frames"][0]["vertices_coords"])
    point[0] = 2 * point[0].get<double>();
  for (Json& letter : drawing["edges_assignment"]) letter = letter == "U" ? "U" : "B";
  EXPECT_FALSE(good(pattern_of(drawing)).folded_target);
  Json several = fold_of(miura);
  several["file_frames"].push_back(several["file_frames"][0]);
  EXPECT_FALSE(good(pattern_of(several)).folded_target);
  Json pattern = pattern_of(several);
  pattern["target_frame"] = 2;
  EXPECT_TRUE(good(pattern).folded_target);
}

// A target that has popped through: with the usual pilot the path turns back before flat. Without
// a name another pilot is found.
TEST_F(TargetMesh, APathThatTurnsBackHasAReason) {
  const DesignedMesh popped = solver::curved_mesh(6, 6, {6e-4, 6e-4}, 14, 6);
  Json pattern = pattern_of(fold_of(popped));
  const auto label = [&](int e) {
    return solver::line_label(popped.flat.edges[e].a, popped.flat.edges[e].b);
  };
  const int usual = solver::default_pilot(popped.flat, solver::checkerboard(popped.flat, 1));
  const Pattern read = good(pattern);
  EXPECT_NE(read.base.folding.pilot_edge(), usual);
  EXPECT_EQ(pattern_json(read, read.shifts_mm)["pilot"], label(read.base.folding.pilot_edge()));
  EXPECT_LT(off_mm(read, popped.folded_mm), 1e-9);
  pattern["pilot"] = label(usual);
  expect_faults(pattern, 1, {"the pilot " + label(usual), "turns back at", "name another crease"});
}

}  // namespace
}  // namespace misalign::schema
