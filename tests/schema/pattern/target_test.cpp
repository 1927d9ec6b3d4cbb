// The target block: what is read has the heights of its formula, and every fault is a sentence.
#include "schema/pattern/target.hpp"

#include <gtest/gtest.h>

#include "schema/pattern/pattern_file.hpp"
#include "tests/folder.hpp"

namespace misalign::schema {
namespace {

Json miura(const Json& target) {
  return {{"family", "miura"},
          {"rows", 4},
          {"columns", 4},
          {"panel_width_mm", 80},
          {"panel_height_mm", 80},
          {"zigzag_offset_mm", 40},
          {"holes", "checkerboard-odd"},
          {"target", target}};
}

Target read_of(const Json& target) {
  return *read_sampled_pattern(miura(target), "a file", {}).target;
}

std::string refused(const Json& target) {
  try {
    read_of(target);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

// Distances from the formulas of target_surface.hpp, at a place on each surface.
TEST(Target, IsTheSurfaceOfItsFormula) {
  const auto distance_mm = [](const Json& target, double x, double y, double z) {
    return read_of(target).shape.surface->distance({x, y, z}).mm;
  };
  const double drop_mm = 500 - std::sqrt(500 * 500 - 60 * 60);
  EXPECT_NEAR(distance_mm({{"surface", "sphere"}, {"radius_mm", 500}}, 60, 0, -drop_mm), 0, 1e-9);
  EXPECT_NEAR(distance_mm({{"surface", "sphere"}, {"radius_mm", -500}}, 60, 0, drop_mm), 0, 1e-9);
  EXPECT_NEAR(
      distance_mm({{"surface", "cylinder"}, {"radius_mm", 500}, {"axis", "x"}}, 200, 60, -drop_mm),
      0, 1e-9);
  EXPECT_NEAR(
      distance_mm({{"surface", "cylinder"}, {"radius_mm", 500}, {"axis", "y"}}, 60, 200, -drop_mm),
      0, 1e-9);
  EXPECT_NEAR(distance_mm({{"surface", "saddle"}, {"radius_mm", 500}}, 60, 20, 3.2), 0, 1e-9);
  EXPECT_NEAR(
      distance_mm({{"surface", "helicoid"}, {"radius_mm", 500}}, 60, 20, 60 * std::tan(20.0 / 500)),
      0, 1e-9);
  EXPECT_NEAR(distance_mm({{"surface", "grid"},
                           {"spacing_mm", 10},
                           {"heights_mm", {{0, 1, 2}, {0, 1, 2}, {0, 1, 2}}}},
                          5, 0, 1.5),
              0, 1e-9);
  EXPECT_NEAR(distance_mm({{"surface", "plane"}}, 5, 0, 1.5), 1.5, 1e-12);
}

TEST(Target, IsOfPanelsOrPlaces) {
  EXPECT_EQ(read_of({{"surface", "plane"}, {"of", "panels"}, {"at_deg", 70}}).shape.measured,
            solver::WantedShape::Measured::panels);
  const Target places =
      read_of({{"vertices_mm", {{"A1", {0, 0, 1}}, {"A3", {90, 0, 0}}, {"A25", {50, 300, 0}}}}});
  ASSERT_EQ(places.shape.places.size(), 3u);
  EXPECT_EQ(places.shape.places[1].vertex, 24) << "in the order of the labels";
  EXPECT_EQ(target_words(places), "places of 3 vertices");
}

TEST(Target, IsAMeshBesideItsFile) {
  const Folder folder("target_mesh");
  folder.file("roof.obj",
              "v -100 -100 0\nv 100 -100 10\nv 100 100 10\nv -100 100 0\n"
              "f 1 2 3 4\n");
  const Json target = {{"surface", "mesh"}, {"file", "roof.obj"}};
  const PatternFile read = read_sampled_pattern(miura(target), "a file", folder.path());
  EXPECT_NEAR(read.target->shape.surface->distance({0, 0, 5}).mm, 0, 1e-9);
  // Files that are written elsewhere find the mesh.
  EXPECT_TRUE(std::filesystem::path(read.target->json["file"].get<std::string>()).is_absolute());
}

TEST(Target, RefusesWithSentences) {
  const std::pair<Json, const char*> kRefused[] = {
      {Json::object(), "has no surface and no places"},
      {{{"surface", "sphere"}, {"vertices_mm", Json::object()}}, "has a surface and places"},
      {{{"surface", "cube"}}, "is no surface that is known"},
      {{{"surface", "sphere"}}, "target.radius_mm"},
      {{{"surface", "sphere"}, {"radius_mm", 0}}, "is no radius of a surface"},
      {{{"surface", "cylinder"}, {"radius_mm", 500}}, "target.axis"},
      {{{"surface", "cylinder"}, {"radius_mm", 500}, {"axis", "z"}}, "is no axis of a cylinder"},
      {{{"surface", "grid"}, {"spacing_mm", 10}, {"heights_mm", {{1, 2}}}},
       "is no grid of two rows and columns or more"},
      {{{"surface", "grid"}, {"spacing_mm", 10}, {"heights_mm", {{1, 2}, {1}}}},
       "is no list of 2 heights"},
      {{{"surface", "mesh"}}, "target.file"},
      {{{"surface", "mesh"}, {"file", "none.obj"}}, "no such file"},
      {{{"surface", "mesh"}, {"file", ""}}, "is no file name"},
      {{{"surface", "mesh"}, {"points_mm", Json::array()}}, "is half of a mesh"},
      {{{"surface", "mesh"},
        {"file", "hull.obj"},
        {"points_mm", Json::array()},
        {"triangles", Json::array()}},
       "is given beside a file"},
      {{{"surface", "mesh"}, {"points_mm", {{0, 0}}}, {"triangles", {{0, 1, 2}}}}, "are no places"},
      {{{"surface", "mesh"}, {"points_mm", {{0, 0, 0}}}, {"triangles", {{0, 0, 1}}}},
       "are no triples of indices"},
      {{{"surface", "plane"}, {"of", "holes"}}, "is no part of a sheet"},
      {{{"surface", "plane"}, {"colour", 1}}, "is not a key here"},
      {{{"surface", "plane"}, {"at_deg", 0}}, "target.at_deg"},
      {{{"vertices_mm", {{"B1", {0, 0, 0}}}}}, "is no vertex of this sheet"},
      {{{"vertices_mm", {{"A1", {0, 0}}}}}, "is no place"},
      {{{"vertices_mm", {{"A1", {0, 0, 0}}, {"A2", {1, 1, 1}}, {"A3", {2, 2, 2}}}}},
       "fewer than three places off one line"}};
  for (const auto& [target, why] : kRefused) {
    EXPECT_NE(refused(target).find(why), std::string::npos)
        << target.dump() << ": " << refused(target);
  }
  const std::string both = refused({{"surface", "cylinder"}, {"radius_mm", 0}, {"axis", "z"}});
  EXPECT_NE(both.find("radius"), std::string::npos) << both;
  EXPECT_NE(both.find("axis"), std::string::npos) << "all faults at once: " << both;
}

TEST(Target, IsWrittenAgain) {
  const Json target = {{"surface", "saddle"}, {"radius_mm", 700}, {"at_deg", 80}};
  const PatternFile read = read_sampled_pattern(miura(target), "a file", {});
  const Json again = pattern_file_json(read.pattern, read.pattern.shifts_mm, read.sampling,
                                       read.design, read.target);
  EXPECT_EQ(read_sampled_pattern(again, "again", {}).target->json, target);
}

}  // namespace
}  // namespace misalign::schema
