// FOLD meshes as patterns: the same sheet gives the same verdicts however it is written down.
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>

#include "schema/campaign/campaign_file.hpp"
#include "schema/pattern/vertex_labels.hpp"
#include "solver/pattern/perforation.hpp"
#include "solver/records/history.hpp"
#include "tests/folder.hpp"
#include "tests/schema/pattern/fold_meshes.hpp"

namespace misalign::schema {
namespace {

/// The shifts of one draw on 4 x 4 by label, and the pattern with them.
Json shifts(unsigned seed) {
  std::mt19937 words(seed);
  Json shifts = Json::object();
  for (const int v : {6, 7, 8, 11, 12, 13, 16, 17, 18}) {
    const double x = 0.4 * (static_cast<int>(words() % 3) - 1);
    shifts[solver::vertex_label(v)] = {x, 0.4 * (static_cast<int>(words() % 3) - 1)};
  }
  return shifts;
}

std::vector<double> sorted(const Eigen::MatrixXd& lengths, Eigen::Index row) {
  std::vector<double> values;
  for (Eigen::Index k = 0; k < lengths.cols(); ++k) values.push_back(lengths(row, k));
  std::sort(values.begin(), values.end());
  return values;
}

/// The same D and fault, and the same lengths, in whatever order: 1e-9 mm, a hundred times what
/// converged paths of other equations differ by.
void expect_same(const Json& one, const Json& other) {
  const auto a = history_of(good(one)), b = history_of(good(other));
  EXPECT_EQ(a.verdict.deploys_from_sample, b.verdict.deploys_from_sample);
  EXPECT_EQ(a.verdict.first_fault, b.verdict.first_fault);
  ASSERT_EQ(a.length_mm.rows(), b.length_mm.rows());
  ASSERT_GT(a.length_mm.rows(), 60);
  for (const Eigen::Index row : {Eigen::Index{9}, Eigen::Index{59}}) {
    const auto of_a = sorted(a.length_mm, row), of_b = sorted(b.length_mm, row);
    ASSERT_EQ(of_a.size(), of_b.size());
    for (std::size_t k = 0; k < of_a.size(); ++k) EXPECT_NEAR(of_a[k], of_b[k], 1e-9);
  }
}

class SameSheet : public testing::TestWithParam<unsigned> {
 protected:
  Json family() const {
    return {
        {"family", "miura"}, {"rows", 4}, {"columns", 4}, {"displacements_mm", shifts(GetParam())}};
  }
  Json fold(const Json& mesh) const {
    Json pattern = pattern_of(mesh);
    pattern["displacements_mm"] = shifts(GetParam());
    return pattern;
  }
};

TEST_P(SameSheet, AsAMiura) { expect_same(family(), fold(miura_mesh(4, 4))); }

TEST_P(SameSheet, MissingFacesAreHoles) {
  Json mesh = miura_mesh(4, 4);
  const auto sides = {std::pair(7, 8), {7, 12},  {8, 13},  {12, 13},
                      {11, 12},        {11, 16}, {12, 17}, {16, 17}};
  mesh["faces_vertices"].erase(9);
  mesh["faces_vertices"].erase(6);
  expect_same(family(), fold(mesh));
  for (const auto& [a, b] : sides) mesh["edges_assignment"][edge_index(mesh, a, b)] = "B";
  expect_same(family(), fold(mesh));  // letters that a hole's sides need not have
}

TEST_P(SameSheet, ClockwiseFacesAndEdgesTurnedRound) {
  Json mesh = miura_mesh(4, 4);
  for (Json& face : mesh["faces_vertices"]) std::reverse(face.begin(), face.end());
  for (Json& letter : mesh["edges_assignment"]) {
    if (letter != "B") letter = letter == "M" ? "V" : "M";
  }
  for (Json& edge : mesh["edges_vertices"]) std::swap(edge[0], edge[1]);
  expect_same(family(), fold(mesh));
}

TEST_P(SameSheet, AnyOrderOfVerticesFacesAndEdges) {
  std::mt19937 words(GetParam() + 77);
  std::vector<int> to(25);  // new number of each vertex
  std::iota(to.begin(), to.end(), 0);
  std::shuffle(to.begin(), to.end(), words);
  const Json whole = miura_mesh(4, 4);
  Json mesh = whole;
  for (int v = 0; v < 25; ++v) mesh["vertices_coords"][to[v]] = whole["vertices_coords"][v];
  for (const char* key : {"faces_vertices", "edges_vertices"}) {
    for (Json& list : mesh[key]) {
      for (Json& v : list) v = to[v.get<int>()];
    }
  }
  mesh["faces_vertices"].erase(9);  // holes by missing faces: rows and columns depend on the first
  mesh["faces_vertices"].erase(6);
  std::shuffle(mesh["faces_vertices"].begin(), mesh["faces_vertices"].end(), words);
  for (Json& face : mesh["faces_vertices"])
    std::rotate(face.begin(), face.begin() + words() % 4, face.end());
  Json pattern = pattern_of(mesh);
  pattern["pilot"] = solver::line_label(std::min(to[1], to[6]), std::max(to[1], to[6]));
  const Json drawn = shifts(GetParam());
  for (const auto& [label, shift] : drawn.items()) {
    pattern["displacements_mm"][solver::vertex_label(to[vertex_of_label(label, 25)])] = shift;
  }
  expect_same(family(), pattern);
}

TEST_P(SameSheet, InAnyUnit) {
  const auto in_units = [&](const Json& unit, double mm, double mm_per_unit) {
    Json mesh = miura_mesh(4, 4);
    mesh.erase("frame_unit");
    if (!unit.is_null()) mesh["frame_unit"] = unit;
    for (Json& p : mesh["vertices_coords"]) {
      p = {p[0].get<double>() / (mm * mm_per_unit), p[1].get<double>() / (mm * mm_per_unit)};
    }
    Json pattern = fold(mesh);
    pattern["mm_per_unit"] = mm_per_unit;
    return pattern;
  };
  expect_same(family(), in_units("cm", 10, 1));
  expect_same(family(), in_units("in", 25.4, 1));
  expect_same(family(), in_units("m", 1000, 1));
  expect_same(family(), in_units(nullptr, 1, 0.125));
  expect_same(family(), in_units("unit", 1, 400));
}

// Draws whose verdicts differ.
INSTANTIATE_TEST_SUITE_P(Draws, SameSheet, testing::Values(1u, 2u, 3u));

TEST(FoldFormat, RoundTrip) {
  for (const Json& mesh :
       {miura_mesh(3, 5),
        read_json_file(MISALIGN_SOURCE_DIR "/search/patterns/turned-quads-6x6.fold"),
        read_json_file(MISALIGN_SOURCE_DIR "/search/patterns/angle-array-6x6.fold")}) {
    InputFaults faults;
    const FoldMesh one = read_fold(mesh, "", 1, faults);
    const Json written = fold_json(one.sheet, one.assignment);
    const FoldMesh again = read_fold(parse_json(written.dump(), "written"), "", 1, faults);
    ASSERT_TRUE(faults.none()) << faults.sentences().front();
    EXPECT_EQ(again.sheet.vertices_mm, one.sheet.vertices_mm);
    EXPECT_EQ(again.sheet.facets, one.sheet.facets);
    EXPECT_EQ(again.sheet.places, one.sheet.places);
    EXPECT_EQ(again.sheet.panel_width_mm, one.sheet.panel_width_mm);
    EXPECT_EQ(again.assignment, one.assignment);
    EXPECT_TRUE(one.missing.empty() && again.missing.empty());
    for (const char* key : {"vertices_coords", "edges_vertices", "edges_assignment"}) {
      EXPECT_EQ(written[key], mesh[key]) << key;
    }
  }
}

// A mountain as the pilot is kept as it is written: seen from +z.
TEST(FoldFormat, PatternsOfACatalogueAreTheFilesOwn) {
  Json mesh = miura_mesh(4, 4);
  for (Json& letter : mesh["edges_assignment"]) {
    if (letter != "B") letter = letter == "M" ? "V" : "M";
  }
  const Pattern pattern = good(pattern_of(mesh));
  EXPECT_EQ(pattern.base.folding.side(), -1);
  const Json kept = pattern_json(pattern, pattern.shifts_mm);
  EXPECT_EQ(kept["mesh"]["edges_assignment"], mesh["edges_assignment"]);
  EXPECT_EQ(pattern_json(good(kept), pattern.shifts_mm), kept);
}

TEST(FoldFormat, IdentityDoesNotDependOnThePath) {
  namespace fs = std::filesystem;
  const Folder folder("fold_identity");
  const fs::path& root = folder.path();
  fs::create_directories(root / "elsewhere");
  const Json mesh = miura_mesh(4, 4);
  std::ofstream(root / "a.fold") << mesh.dump();
  std::ofstream(root / "elsewhere" / "b.fold") << mesh.dump(3);
  Json moved = mesh;
  moved["vertices_coords"][0] = {-1, 0};
  std::ofstream(root / "c.fold") << moved.dump();
  const auto identity_with = [&](const Json& pattern) {
    std::ofstream(root / "campaign.json") << Json{{"pattern", pattern}};
    return identity(read_campaign_file((root / "campaign.json").string()));
  };
  const auto of_file = [&](const std::string& file) {
    return identity_with({{"family", "fold"}, {"file", file}});
  };
  const std::string expected = identity_with(pattern_of(mesh));
  EXPECT_EQ(of_file("a.fold"), expected);
  EXPECT_EQ(of_file("elsewhere/../elsewhere/b.fold"), expected);
  EXPECT_EQ(of_file((root / "elsewhere" / "b.fold").string()), expected);
  EXPECT_NE(of_file("c.fold"), expected);
}

}  // namespace
}  // namespace misalign::schema
